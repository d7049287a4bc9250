// SPDX-License-Identifier: MIT
// From linear light to the 8 bits a screen shows, as a user asks for it.
#pragma once
#include "metamarch/shared/tone_mapping.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string_view>

namespace metamarch {

struct ToneOperatorName {
    std::string_view name; // on the command line
    std::uint32_t toneOperator;
};

inline constexpr ToneOperatorName kToneOperators[] = {
    {"none", kToneNone}, {"neutral", kToneNeutral}, {"aces", kToneAces}, {"agx", kToneAgx}};

struct ToneMapping {
    std::uint32_t toneOperator = kToneNone;
    float exposure = 0.0f; // stops: light is doubled by each

    bool operator==(const ToneMapping&) const = default;
};

// What radiance is multiplied by.
float exposureScale(const ToneMapping& mapping);

// shared/tone_mapping.h's, with the exposure of `mapping`.
glm::vec3 toneMapped(const ToneMapping& mapping, glm::vec3 radiance);

} // namespace metamarch
