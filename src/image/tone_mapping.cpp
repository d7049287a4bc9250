#include "image/tone_mapping.h"

#include <cmath>

namespace metamarch {

std::uint8_t toLinear8(float value) {
    if (!(value > 0.0f)) // NaN too
        return 0;
    if (value >= 1.0f)
        return 255;
    return static_cast<std::uint8_t>(std::lround(value * 255.0f));
}

std::uint8_t toSrgb8(float linear) {
    if (!(linear > 0.0f))
        return 0;
    if (linear >= 1.0f)
        return 255;
    const float encoded =
        linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
    return toLinear8(encoded);
}

} // namespace metamarch
