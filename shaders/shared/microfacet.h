// SPDX-License-Identifier: MIT
// The Trowbridge-Reitz (GGX) distribution of microfacets with Smith masking, and the sampling of the facets
// that are visible from a direction. Directions are in the frame of the surface, whose normal is the z axis;
// alpha is the roughness along x and y. E. Heitz, "Understanding the Masking-Shadowing Function in
// Microfacet-Based BRDFs", JCGT 3(2), 2014.
#ifndef METAMARCH_SHARED_MICROFACET_H
#define METAMARCH_SHARED_MICROFACET_H
#include "math.h"

SHARED_BEGIN

// The alpha of perceptual roughness 0.01. For smaller alphas the half vector has too few bits for the
// distribution. A lobe with this alpha is a delta.
const float kMinAlpha = 1e-4f;
const float kMinCosine = 1e-6f; // smallest cosine between wo and a normal; rounding could make it 0

// The distribution D: facets per area and solid angle around `normal`.
SHARED_FN float facetDensity(const vec3 normal, const vec2 alpha) {
    const float x = normal.x / alpha.x;
    const float y = normal.y / alpha.y;
    const float k = x * x + y * y + normal.z * normal.z;
    return 1.0f / (kPi * alpha.x * alpha.y * k * k);
}

// The length of w in the space in which the facets lie on a sphere. Smith's Lambda is (length / w.z - 1) / 2.
SHARED_FN float facetLength(const vec3 w, const vec2 alpha) {
    const float x = w.x * alpha.x;
    const float y = w.y * alpha.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// The pdf per solid angle of mirroring wo at the facets visible from it, for the direction whose half vector
// is `normal`: D * G1 / (4 cos). `lengthOut` is facetLength(wo).
SHARED_FN float mirrorDensity(const vec3 normal, const float cosOut, const float lengthOut,
                              const vec2 alpha) {
    return facetDensity(normal, alpha) / (2.0f * (cosOut + lengthOut));
}

// The fraction of the light from facets visible from wo that other facets do not block towards the second
// direction: G2 / G1 with height-correlated masking, or G1 of the second direction if the two sides of the
// surface are independent. Cosines are positive.
SHARED_FN float facetPassage(const float cosOut, const float lengthOut, const float cosIn,
                             const float lengthIn, const bool isIndependent) {
    const float seen = (cosOut + lengthOut) * cosIn;
    const float shadowed = (lengthIn - cosIn) * (isIndependent ? cosOut + lengthOut : 2.0f * cosOut);
    return 2.0f * seen / (2.0f * seen + shadowed);
}

// Which of the facets visible from wo are sampled: all (bound 1), or as few as the bound allows that contain
// all that mirror wo above the surface.
struct FacetBound {
    float bound;   // in [0, 1], of the height of the spherical cap
    float density; // of a sampled facet, relative to that among all visible ones
};

const FacetBound kAllFacets = FacetBound(1.0f, 1.0f);

// Y. Tokuyoshi, K. Eto, "Bounded VNDF Sampling for Smith-GGX Reflections", SIGGRAPH Asia 2023. `lengthOut` is
// facetLength(wo).
SHARED_FN FacetBound mirroringFacets(const vec3 wo, const vec2 alpha, const float lengthOut) {
    const float square = squared(min(alpha.x, alpha.y));
    const float reach = squared(1.0f + sqrt(wo.x * wo.x + wo.y * wo.y));
    const float bound = (1.0f - square) * reach / (reach + square * wo.z * wo.z);
    return FacetBound(bound, (lengthOut + wo.z) / (lengthOut + bound * wo.z));
}

// Samples the normal of a facet visible from `wo`, in proportion to projected areas. J. Dupuy, A. Benyoub,
// "Sampling Visible GGX Normals with Spherical Caps", CGF 42(8), 2023.
SHARED_FN vec3 sampleFacet(const vec3 wo, const vec2 alpha, const FacetBound among, const vec2 u) {
    const vec3 stretched = unitVector(vec3(wo.x * alpha.x, wo.y * alpha.y, wo.z));
    const float depth = among.bound * stretched.z;
    const float z = (1.0f - u.y) * (1.0f + depth) - depth;
    const float radius = sqrt(max(1.0f - z * z, 0.0f));
    const vec2 circle = circlePoint(u.x);
    const vec3 onSphere =
        vec3(radius * circle.x + stretched.x, radius * circle.y + stretched.y, z + stretched.z);
    return unitVector(vec3(onSphere.x * alpha.x, onSphere.y * alpha.y, max(onSphere.z, 1e-12f)));
}

SHARED_END
#endif
