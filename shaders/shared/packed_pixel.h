// SPDX-License-Identifier: MIT
// Converts linear light to the 8 bits of a screen.
#ifndef METAMARCH_SHARED_PACKED_PIXEL_H
#define METAMARCH_SHARED_PACKED_PIXEL_H
#include "math.h"

SHARED_BEGIN

// Clamps to [0, 1] and rounds to the nearest of 256 values. NaN becomes 0.
SHARED_FN uint toLinear8(const float value) {
    const float inside = value > 0.0f ? min(value, 1.0f) : 0.0f;
    return uint(inside * 255.0f + 0.5f); // NOLINT(bugprone-incorrect-roundings): GLSL has no lround
}

// The sRGB curve of IEC 61966-2-1.
SHARED_FN float srgbCoded(const float linear) {
    const float low = 12.92f * linear;
    const float high = 1.055f * power(max(linear, 0.0031308f), 0.416666667f) - 0.055f;
    return linear > 0.0031308f ? high : low;
}

// Applies the sRGB curve and rounds.
SHARED_FN uint toSrgb8(const float linear) { return toLinear8(srgbCoded(min(linear, 1.0f))); }

// Packs an sRGB-coded colour as an opaque pixel. Red is in the lowest byte, as in VK_FORMAT_R8G8B8A8_UNORM.
SHARED_FN uint packedPixel(const vec3 coded) {
    return toLinear8(coded.x) | (toLinear8(coded.y) << 8u) | (toLinear8(coded.z) << 16u) | 0xff000000u;
}

SHARED_FN uint packedLinear(const vec3 linear) {
    return toSrgb8(linear.x) | (toSrgb8(linear.y) << 8u) | (toSrgb8(linear.z) << 16u) | 0xff000000u;
}

SHARED_END
#endif
