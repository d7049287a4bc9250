// SPDX-License-Identifier: MIT
// What a window shows behind the scene in place of its surroundings: a few texels, spread over the window, as
// linear light of the screen. Films know nothing of it.
#ifndef METAMARCH_SHARED_BACKDROP_H
#define METAMARCH_SHARED_BACKDROP_H
#include "packed_pixel.h"

SHARED_BEGIN

const uint kBindBackdrop = 54u; // vec4, in rows from the top

// Specialization constant of the kernel `present`: 1 if there is a backdrop. Drivers that run both sides of a
// branch would mix each pixel (llvmpipe: 18 frames per second in place of 28 at 1280 x 800).
const uint kSpecBackdrop = 6u;

// A packed pixel's alpha is 0 where nothing is known, otherwise 1 + kCovered times the part of the pixel that
// something covers.
const uint kCovered = 254u;
const uint kUncovered = 0x01000000u; // the alpha of a pixel that nothing covers

SHARED_FN uint withCoverage(const uint pixel, const float coverage) {
    const float inside = min(max(coverage, 0.0f), 1.0f);
    return (pixel & 0xffffffu) | (uint(1.5f + inside * float(kCovered)) << 24u);
}

// The inverse of srgbCoded.
SHARED_FN float srgbLinear(const float coded) {
    const float high = power((max(coded, 0.04045f) + 0.055f) / 1.055f, 2.4f);
    return coded > 0.04045f ? high : coded / 12.92f;
}

SHARED_FN vec3 linearOf(const uint pixel) {
    return vec3(srgbLinear(float(pixel & 0xffu) / 255.0f), srgbLinear(float((pixel >> 8u) & 0xffu) / 255.0f),
                srgbLinear(float((pixel >> 16u) & 0xffu) / 255.0f));
}

// Lays a pixel, whose light is that of its covered part, over the backdrop. The result is opaque.
SHARED_FN uint overBackdrop(const uint pixel, const vec3 backdrop) {
    const uint alpha = pixel >> 24u;
    if (alpha == kCovered + 1u) {
        return pixel;
    }
    const float open = 1.0f - float(max(alpha, 1u) - 1u) / float(kCovered);
    const vec3 own = alpha <= 1u ? vec3(0.0f) : linearOf(pixel); // a view may colour what it has not met
    return packedLinear(own + backdrop * open);
}

// The texels around a place, and the place between them.
struct BackdropPlace {
    uint upperLeft;
    uint upperRight;
    uint lowerLeft;
    uint lowerRight;
    float right; // from 0 to 1
    float down;
};

SHARED_FN float alongBackdrop(const uint i, const uint size, const uint texels) {
    const float place = (float(i) + 0.5f) * float(texels) / float(size) - 0.5f;
    return min(max(place, 0.0f), float(texels - 1u));
}

// Returns where pixel x, y of a window lies, with texels at the centres of columns * rows fields.
SHARED_FN BackdropPlace backdropPlace(const uint x, const uint y, const uint width, const uint height,
                                      const uint columns, const uint rows) {
    const float across = alongBackdrop(x, width, columns);
    const float down = alongBackdrop(y, height, rows);
    const uint left = uint(across);
    const uint right = min(left + 1u, columns - 1u);
    const uint upper = uint(down) * columns;
    const uint lower = min(uint(down) + 1u, rows - 1u) * columns;
    return BackdropPlace(upper + left, upper + right, lower + left, lower + right, across - float(left),
                         down - float(uint(down)));
}

SHARED_FN vec3 backdropBetween(const vec3 upperLeft, const vec3 upperRight, const vec3 lowerLeft,
                               const vec3 lowerRight, const BackdropPlace place) {
    const vec3 upper = blend3(upperLeft, upperRight, place.right);
    const vec3 lower = blend3(lowerLeft, lowerRight, place.right);
    return blend3(upper, lower, place.down);
}

SHARED_END
#endif
