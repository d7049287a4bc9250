// From linear light to the 8 bits a screen shows.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <string_view>

namespace metamarch {

// One of these, for every pixel alike: what a screen cannot show is to be
//   none     cut off at 1 in each channel.
//   neutral  compressed, and whitened with its brightness; a colour up to about 0.8 stays as it is, but for
//            the 0.04 that a dielectric reflects. Khronos PBR Neutral Tone Mapper, 2024: colours of
//            materials on the screen are those of their textures.
//   aces     on film: S. Hill's fit of the ACES reference rendering and sRGB output transforms (M. Pettineo,
//            BakingLab, ACES.hlsl, 2016), without an exposure of its own.
//   agx      on film that loses colour with light: T. Sobotka's AgX, B. Wrensch's fit of the base contrast
//            ("Minimal AgX Implementation", 2023), its 2.2 power taken off again.
enum class ToneOperator { none, neutral, aces, agx };

struct ToneOperatorName {
    std::string_view name; // on the command line
    ToneOperator toneOperator;
};

inline constexpr ToneOperatorName kToneOperators[] = {{"none", ToneOperator::none},
                                                      {"neutral", ToneOperator::neutral},
                                                      {"aces", ToneOperator::aces},
                                                      {"agx", ToneOperator::agx}};

struct ToneMapping {
    ToneOperator toneOperator = ToneOperator::none;
    float exposure = 0.0f; // stops: light is doubled by each
};

// From linear Rec. 709 radiance to linear Rec. 709 that a screen shows, each channel in [0, 1]. Negative
// radiance and NaN count as 0, infinite radiance as more than enough.
glm::vec3 toneMapped(const ToneMapping& mapping, glm::vec3 radiance);

// Clamp to [0, 1], then the sRGB curve (IEC 61966-2-1), rounded to the nearest of 256 values. NaN becomes 0.
std::uint8_t toSrgb8(float linear);

// Alpha and other values that are no light: clamp and round only. NaN becomes 0.
std::uint8_t toLinear8(float value);

} // namespace metamarch
