// SPDX-License-Identifier: MIT
// The reflectance of a thin film over a base: KHR_materials_iridescence, after L. Belcour, P. Barla, "A
// Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", 2017.
#ifndef METAMARCH_SHARED_IRIDESCENCE_H
#define METAMARCH_SHARED_IRIDESCENCE_H
#include "fresnel.h"

SHARED_BEGIN

// Interference of two light paths, seen by a sensor with a Gaussian response over wavelengths: the cosine of
// the phase between the paths, and a decay that grows with the difference of their lengths.
struct Fringe {
    float cosine;
    float decay;
};

// `cycles` and `width` are per nanometre of path difference.
SHARED_FN Fringe fringeAt(const float pathDifference, const float cycles, const float width) {
    const float turns = cycles * pathDifference;
    const vec2 point = circlePoint(turns);
    const float cosine = point.x;
    const float decay = exponential(-squared(width * pathDifference));
    return Fringe(cosine, decay);
}

SHARED_FN vec3 rec709FromXyz(const vec3 xyz) {
    return vec3(3.2404542f * xyz.x - 1.5371385f * xyz.y - 0.4985314f * xyz.z,
                -0.9692660f * xyz.x + 1.8760108f * xyz.y + 0.0415560f * xyz.z,
                0.0556434f * xyz.x - 0.2040259f * xyz.y + 1.0572252f * xyz.z);
}

// Returns the reflectance per colour channel, in [0, 1]. The outside medium is air. `thickness` of the film
// is in nanometres; `baseF0` is the base's reflectance in air at normal incidence.
SHARED_FN vec3 filmReflectance(const float cosine, const float filmIor, const float thickness,
                               const vec3 baseF0) {
    const float cosInFilm = sqrt(max(1.0f - (1.0f - cosine * cosine) / (filmIor * filmIor), 0.0f));
    const float topF0 = normalReflectance(filmIor);
    const float top = topF0 + (1.0f - topF0) * schlickWeight(cosine);
    const float passed = 1.0f - top;
    const vec3 rootF0 = sqrt(min(baseF0 + 0.0001f, vec3(0.9999f))); // keeps the base's ior finite
    const vec3 baseIor = (vec3(1.0f) + rootF0) / (vec3(1.0f) - rootF0);
    const vec3 rootBottomF0 = (baseIor - filmIor) / (baseIor + filmIor);
    const vec3 bottomF0 = rootBottomF0 * rootBottomF0;
    const vec3 bottom = bottomF0 + (vec3(1.0f) - bottomF0) * schlickWeight(cosInFilm);

    // The paper's four Gaussians for X (two), Y and Z, with its phases per metre converted to cycles per
    // nanometre.
    const float pathDifference = 2.0f * filmIor * thickness * cosInFilm;
    const Fringe x0 = fringeAt(pathDifference, 1.6810e-3f, 4.1334573e-4f);
    const Fringe x1 = fringeAt(pathDifference, 2.2399e-3f, 4.2280749e-4f);
    const Fringe y = fringeAt(pathDifference, 1.7953e-3f, 6.0607828e-4f);
    const Fringe z = fringeAt(pathDifference, 2.2084e-3f, 5.1091608e-4f);
    const vec3 first = vec3(0.84659000f * x0.cosine * x0.decay + 0.15386831f * x1.cosine * x1.decay,
                            1.00022189f * y.cosine * y.decay, 1.00112249f * z.cosine * z.decay);
    // Twice the path difference: cos 2p = 2 cos^2 p - 1, and the decay's exponent is four times as large.
    const vec3 second =
        vec3(0.84659000f * (2.0f * squared(x0.cosine) - 1.0f) * squared(squared(x0.decay)) +
                 0.15386831f * (2.0f * squared(x1.cosine) - 1.0f) * squared(squared(x1.decay)),
             1.00022189f * (2.0f * squared(y.cosine) - 1.0f) * squared(squared(y.decay)),
             1.00112249f * (2.0f * squared(z.cosine) - 1.0f) * squared(squared(z.decay)));
    // Reflection at a denser medium shifts the phase by half a cycle. Inside the film this happens only at
    // the base, and only if the base is denser.
    const vec3 turn = vec3(baseIor.x < filmIor ? 1.0f : -1.0f, baseIor.y < filmIor ? 1.0f : -1.0f,
                           baseIor.z < filmIor ? 1.0f : -1.0f);

    const vec3 roundTrip = min(max(top * bottom, vec3(1e-5f)), vec3(0.9999f));
    const vec3 within = passed * passed * bottom / (vec3(1.0f) - roundTrip);
    const vec3 amplitude = 2.0f * (within - passed);
    const vec3 reflectance = vec3(top) + within + amplitude * sqrt(roundTrip) * rec709FromXyz(first * turn) +
                             amplitude * roundTrip * rec709FromXyz(second);
    return min(max(reflectance, vec3(0.0f)), vec3(1.0f));
}

struct Film {
    float strength; // 0: no film
    float ior;
    float thickness; // nanometres
};

// Blends the reflectances without and with the film by the film's strength.
SHARED_FN vec3 underFilm(const Film film, const vec3 reflectance, const vec3 filmed) {
    return film.strength > 0.0f ? blend3(reflectance, filmed, film.strength) : reflectance;
}

SHARED_END
#endif
