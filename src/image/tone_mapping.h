// From linear light to the 8 bits a screen shows.
#pragma once
#include <cstdint>

namespace metamarch {

// One global operator for every pixel and channel: clamp to [0, 1], then the sRGB curve (IEC 61966-2-1),
// rounded to the nearest of 256 values. NaN becomes 0.
std::uint8_t toSrgb8(float linear);

// Alpha and other values that are no light: clamp and round only. NaN becomes 0.
std::uint8_t toLinear8(float value);

} // namespace metamarch
