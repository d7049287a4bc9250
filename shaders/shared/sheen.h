// SPDX-License-Identifier: MIT
// The sheen of KHR_materials_sheen: A. Conty Estevez, C. Kulla, "Production Friendly Microfacet Sheen BRDF",
// 2017.
#ifndef METAMARCH_SHARED_SHEEN_H
#define METAMARCH_SHARED_SHEEN_H
#include "math.h"

SHARED_BEGIN

// Minimum of the perceptual roughness. Below it, the published lobe reflects more light than it receives (2.9
// times at 0.07, at grazing angles).
const float kMinSheenRoughness = 0.26f;

// The published fit of the lobe's Lambda for one cosine. Above 0.5 it is mirrored at 0.5.
SHARED_FN float sheenLambda(const float cosine, const float alpha) {
    const float t = squared(1.0f - alpha);
    const float a = blend(21.5473f, 25.3245f, t);
    const float b = blend(3.82987f, 3.32435f, t);
    const float c = blend(0.19823f, 0.16801f, t);
    const float d = blend(-1.97760f, -1.27393f, t);
    const float e = blend(-4.32054f, -4.85967f, t);
    const bool isHigh = cosine >= 0.5f;
    const float x = max(isHigh ? 1.0f - cosine : cosine, 1e-6f);
    const float l = a / (1.0f + b * power(x, c)) + d * x + e;
    const float middle = a / (1.0f + b * power(0.5f, c)) + d * 0.5f + e;
    return exponential(isHigh ? 2.0f * middle - l : l);
}

// The lobe for white sheen, times |cos in|. `halfCosine` is the half vector's cosine; `roughness` must be
// clamped already.
SHARED_FN float sheenLobe(const float cosOut, const float cosIn, const float halfCosine,
                          const float roughness) {
    const float alpha = roughness * roughness;
    const float sineSquared = max(1.0f - halfCosine * halfCosine, 1e-12f);
    const float density = (2.0f + 1.0f / alpha) * power(sineSquared, 0.5f / alpha) * (0.5f * kInvPi);
    const float passage = 1.0f / (1.0f + sheenLambda(cosOut, alpha) + sheenLambda(cosIn, alpha));
    return density * passage / (4.0f * cosOut);
}

SHARED_END
#endif
