// SPDX-License-Identifier: MIT
// The clear coat of KHR_materials_clearcoat: isotropic microfacets with ior 1.5 and a separate normal.
#ifndef METAMARCH_SHARED_COAT_H
#define METAMARCH_SHARED_COAT_H
#include "albedo.h"
#include "fresnel.h"
#include "microfacet.h"

SHARED_BEGIN

const float kCoatF0 = 0.04f; // reflectance of ior 1.5 at normal incidence

struct Coat {
    vec3 wo; // in the frame of the coat's normal
    float strength;
    Basis around;
    vec3 normal;
    float alpha;
    float lengthOut; // facetLength of wo
    FacetBound sampled;
    bool isSmooth; // the lobe is a delta
    bool isSingleScatter;
    float albedo; // for light towards wo
};

struct CoatLobe {
    float value; // BSDF times |cosine|
    float density;
};

// `alpha` is at least kMinAlpha; the coat is smooth if it equals that. The Khronos text evaluates the Fresnel
// term at wo. The coat does so too if `isSingleScatter`, otherwise at the facets.
SHARED_FN Coat makeCoat(const vec3 normal, const float strength, const float alpha,
                        const bool isSingleScatter, const vec3 wo) {
    const Basis around = basisAround(normal);
    const vec3 local = vec3(dotProduct(wo, around.tangent), dotProduct(wo, around.bitangent),
                            max(dotProduct(wo, normal), kMinCosine));
    const bool isSmooth = alpha <= kMinAlpha;
    const FacetAlbedo facets = facetAlbedo(local.z, alpha);
    const float rough = kCoatF0 * (facets.whole - facets.grazing) + facets.grazing;
    const float mirror = blend(kCoatF0, 1.0f, schlickWeight(local.z));
    const float albedo = strength * (isSingleScatter || isSmooth ? mirror : rough);
    const vec2 both = vec2(alpha, alpha);
    const float lengthOut = facetLength(local, both);
    return Coat(local, strength, around, normal, alpha, lengthOut, mirroringFacets(local, both, lengthOut),
                isSmooth, isSingleScatter, albedo);
}

// Evaluates the coat towards wi (world space). If `isMirror`, evaluates the delta, with a density of 1.
SHARED_FN CoatLobe coatLobe(const Coat coat, const vec3 wi, const bool isMirror) {
    const float cosIn = dotProduct(wi, coat.normal);
    const vec3 incoming =
        vec3(dotProduct(wi, coat.around.tangent), dotProduct(wi, coat.around.bitangent), abs(cosIn));
    const vec3 facet = unitVector(coat.wo + incoming);
    const vec2 alpha = vec2(coat.alpha, coat.alpha);
    const float density = mirrorDensity(facet, coat.wo.z, coat.lengthOut, alpha);
    const float passage =
        facetPassage(coat.wo.z, coat.lengthOut, incoming.z, facetLength(incoming, alpha), false);
    const float cosine = coat.isSingleScatter ? coat.wo.z : dotProduct(coat.wo, facet);
    const float fresnel = coat.strength * blend(kCoatF0, 1.0f, schlickWeight(cosine));
    const bool isRough = !isMirror && !coat.isSmooth && cosIn > 0.0f;
    const float value = isMirror ? fresnel : isRough ? fresnel * density * passage : 0.0f;
    return CoatLobe(value, isMirror ? 1.0f : isRough ? density * coat.sampled.density : 0.0f);
}

SHARED_END
#endif
