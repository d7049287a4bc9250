// SPDX-License-Identifier: MIT
// The user's choice of the mapping from linear light to the 8 bits of a screen.
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
    float exposure = 0.0f; // in stops; each doubles the light

    bool operator==(const ToneMapping&) const = default;
};

// Returns the factor that the exposure multiplies radiance by.
float exposureScale(const ToneMapping& mapping);

// Applies toneMapped of shared/tone_mapping.h with the exposure and the operator of `mapping`.
glm::vec3 toneMapped(const ToneMapping& mapping, glm::vec3 radiance);

} // namespace metamarch
