// SPDX-License-Identifier: MIT
// The reflectance of a smooth interface. Every cosine is that of the angle to the (micro)facet's normal.
#ifndef METAMARCH_SHARED_FRESNEL_H
#define METAMARCH_SHARED_FRESNEL_H
#include "math.h"

SHARED_BEGIN

// Reflectance goes from f0 to f90: f0 + (f90 - f0) * weight. C. Schlick, "An Inexpensive BRDF Model for
// Physically-based Rendering", 1994.
SHARED_FN float schlickWeight(const float cosine) {
    const float x = min(max(1.0f - cosine, 0.0f), 1.0f);
    const float x2 = x * x;
    return x2 * x2 * x;
}

// The reflectance at normal incidence between media whose refractive indices have the ratio `eta`.
SHARED_FN float normalReflectance(const float eta) { return squared((eta - 1.0f) / (eta + 1.0f)); }

// Refraction into a medium whose refractive index is `eta` times that of the light's current medium.
struct Refraction {
    float cosine;      // on the far side of the interface; 0 for total internal reflection
    float reflectance; // Fresnel's equations for unpolarised light
};

SHARED_FN Refraction refractionAt(const float cosine, const float eta) {
    const float beyondSquared = 1.0f - (1.0f - cosine * cosine) / (eta * eta);
    const float beyond = sqrt(max(beyondSquared, 0.0f));
    const float s = (cosine - eta * beyond) / (cosine + eta * beyond);
    const float p = (eta * cosine - beyond) / (eta * cosine + beyond);
    const float reflectance = 0.5f * (s * s + p * p);
    return Refraction(beyond, beyondSquared > 0.0f ? reflectance : 1.0f);
}

SHARED_END
#endif
