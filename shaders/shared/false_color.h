// SPDX-License-Identifier: MIT
// Colours that stand for numbers.
#ifndef METAMARCH_SHARED_FALSE_COLOR_H
#define METAMARCH_SHARED_FALSE_COLOR_H
#include "packed_pixel.h"
#include "sobol.h"

SHARED_BEGIN

// Returns the sRGB-coded heat map colour of `part`, from 0 to 1: black, violet, orange and pale yellow, in
// the order of lightness. It is the colour map `inferno` of Matplotlib (S. van der Walt, N. Smith, 2015), by
// the polynomials that M. Zucker fitted to it (CC0).
SHARED_FN vec3 heatColor(const float part) {
    const float t = part > 0.0f ? min(part, 1.0f) : 0.0f;
    const vec3 t6 = vec3(25.13112622f, -12.24266895f, -23.070325f) * t;
    const vec3 t5 = (vec3(-71.31942824f, 32.62606426f, 73.20951986f) + t6) * t;
    const vec3 t4 = (vec3(77.16293570f, -33.40235894f, -81.80730926f) + t5) * t;
    const vec3 t3 = (vec3(-41.70399613f, 17.43639888f, 44.3541452f) + t4) * t;
    const vec3 t2 = (vec3(11.60249308f, -3.972853966f, -15.9423941f) + t3) * t;
    const vec3 t1 = (vec3(0.1065134195f, 0.5639564368f, 3.932712388f) + t2) * t;
    return vec3(0.0002189403692f, 0.001651004631f, -0.01948089844f) + t1;
}

const float kDepthBands = 16.0f; // number of bands from the depth that is white to the one that is black

// Goes from white (`part` is 0) to black (1), in bands whose edges look like the contour lines of a map.
SHARED_FN vec3 depthColor(const float part) {
    const float within = min(max(part, 0.0f), 1.0f);
    const float bands = within * kDepthBands;
    return vec3((1.0f - within) * (1.0f - 0.08f * (bands - floor(bands))));
}

// Returns linear Rec. 709, which may lie outside [0, 1]. B. Ottosson, "A perceptual color space for image
// processing" (Oklab), 2020.
SHARED_FN vec3 oklabColor(const float lightness, const float a, const float b) {
    const float l = lightness + 0.3963377774f * a + 0.2158037573f * b;
    const float m = lightness - 0.1055613458f * a - 0.0638541728f * b;
    const float s = lightness - 0.0894841775f * a - 1.2914855480f * b;
    const float l3 = l * l * l;
    const float m3 = m * m * m;
    const float s3 = s * s * s;
    return vec3(4.0767416621f * l3 - 3.3077115913f * m3 + 0.2309699292f * s3,
                -1.2684380046f * l3 + 2.6097574011f * m3 - 0.3413193965f * s3,
                -0.0041960863f * l3 - 0.7034186147f * m3 + 1.7076147010f * s3);
}

// Returns a linear colour for an id. It may have any hue, but lightness and chroma vary little, so that no id
// stands out and shading stays visible.
SHARED_FN vec3 idColor(const uint id) {
    const uint bits = hashed(id + 1u); // 0 would map to itself
    const vec2 hue = circlePoint(float(bits & 0xffffu) * (1.0f / 65536.0f));
    const float lightness = 0.62f + 0.2f * float((bits >> 16u) & 255u) * (1.0f / 255.0f);
    const float chroma = 0.08f + 0.06f * float(bits >> 24u) * (1.0f / 255.0f);
    return max(oklabColor(lightness, chroma * hue.x, chroma * hue.y), vec3(0.0f));
}

// Shades a colour as a lamp at the eye would, so that shapes are visible. `cosine` is that between the ray
// and the normal.
SHARED_FN vec3 shadedColor(const vec3 color, const float cosine) {
    return color * (0.3f + 0.7f * abs(cosine));
}

SHARED_END
#endif
