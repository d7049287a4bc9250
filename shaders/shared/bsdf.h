// SPDX-License-Identifier: MIT
// Evaluates and samples the BSDF of bsdf_model.h. Sampling chooses one lobe; the pdf is that of the whole
// mixture. Directions have unit length, are in world space and point away from the surface.
//
// Lobes whose alpha is at most kMinAlpha are deltas: evalBsdf ignores them, and sampleBsdf flags its samples
// of them.
#ifndef METAMARCH_SHARED_BSDF_H
#define METAMARCH_SHARED_BSDF_H
#include "bsdf_model.h"

SHARED_BEGIN

// Values of BsdfDirection::lobe, also taken by evaluateDirection. The smooth lobes are evaluated one at a
// time.
const uint kLobeRough = 0u; // the mixture of all lobes that are not deltas
const uint kLobeSmoothBase = 1u;
const uint kLobeSmoothCoat = 2u;
const uint kLobeNone = 3u; // the sample is lost

// Bits of BsdfSample::flags.
const uint kSampleDelta = 1u;
const uint kSampleTransmitted = 2u;

struct BsdfValue {
    vec3 value; // BSDF times |cosine|
    float pdf;  // of sampleBsdf, over all rough lobes, per solid angle
};

struct BsdfDirection {
    vec3 wi;
    uint lobe;
};

struct BsdfSample {
    vec3 wi;
    float pdf;   // for a delta 1, which has no meaning: no other technique can find wi
    vec3 weight; // BSDF times |cosine| divided by pdf; 0: the path ends
    uint flags;
    float radianceScale; // a factor of weight: radiance scales with the square of the refractive index
};

SHARED_FN vec3 inFrame(const SurfaceFrame frame, const vec3 w) {
    return vec3(dotProduct(w, frame.tangent), dotProduct(w, frame.bitangent), dotProduct(w, frame.normal));
}

// Returns the factor by which radiance changes on its way through the surface to wo; it differs from 1 only
// for refraction.
SHARED_FN float radianceScaleOf(const Bsdf bsdf, const bool isThrough) {
    return isThrough && bsdf.isRefractive ? 1.0f / (bsdf.trueEta * bsdf.trueEta) : 1.0f;
}

// The microfacets that scatter wi to wo.
struct FacetPair {
    vec3 normal;
    float cosOut;  // cosine between wo and the facets' normal
    float density; // pdf of wi, per solid angle, if all facets visible from wo are sampled
    float passage;
};

// Handles reflection, refraction, and transmission through a thin wall, whose lobe is the reflected one
// mirrored at the surface.
SHARED_FN FacetPair facetsTowards(const Bsdf bsdf, const vec3 incoming) {
    const bool isThrough = incoming.z < 0.0f;
    const bool isRefracted = isThrough && bsdf.isRefractive;
    const float cosIn = abs(incoming.z);
    const float eta = isRefracted ? bsdf.eta : 1.0f;
    const vec3 folded = vec3(incoming.x, incoming.y, isRefracted ? incoming.z : cosIn);
    const vec3 sum = bsdf.wo + folded * eta;
    const vec3 normal = unitVector(sum.z < 0.0f ? -sum : sum);
    const float facetOut = dotProduct(bsdf.wo, normal);
    const float facetIn = dotProduct(folded, normal);
    const bool isFacing = facetOut > 0.0f && (!isRefracted || facetIn < 0.0f);

    const float bend = facetOut + eta * facetIn;
    const float spread = isRefracted ? 4.0f * facetOut * eta * eta * abs(facetIn) / (bend * bend) : 1.0f;
    const float density = mirrorDensity(normal, bsdf.wo.z, bsdf.lengthOut, bsdf.alpha) * spread;
    const float passage = facetPassage(bsdf.wo.z, bsdf.lengthOut, cosIn, facetLength(incoming, bsdf.alpha),
                                       bsdf.isSingleScatter && isThrough);
    return FacetPair(normal, max(facetOut, 0.0f), isFacing ? density : 0.0f, passage);
}

// Evaluates one smooth lobe towards its only direction, or all rough lobes together. evalBsdf and sampleBsdf
// call this. A kernel can call it in a loop, for the light's direction and for the sampled one, so that it is
// compiled only once.
SHARED_FN BsdfValue evaluateDirection(const Bsdf bsdf, const vec3 wi, const uint lobe) {
    const vec3 incoming = inFrame(bsdf.frame, wi);
    const float cosIn = abs(incoming.z);
    const bool isThrough = incoming.z < 0.0f;
    const bool isRough = lobe == kLobeRough;
    const bool isSmoothBase = lobe == kLobeSmoothBase;
    const float radianceScale = radianceScaleOf(bsdf, isThrough);

    vec3 value = vec3(0.0f);
    float pdf = 0.0f;
    float left = 1.0f; // fraction of the light left for the diffuse lobe
    if (bsdf.hasFacets) {
        const FacetPair facets = facetsTowards(bsdf, incoming);
        const FacetColors colors = facetColors(bsdf, isSmoothBase ? bsdf.wo.z : facets.cosOut);
        const float alphaIn = alphaTowards(bsdf, incoming);
        const float added = bsdf.balanceOut * facetBalance(cosIn, alphaIn) - 1.0f;
        const vec3 reflected = colors.reflected + bsdf.multiple * added;
        const vec3 through = colors.through + bsdf.throughColor * (bsdf.multipleThrough * added);
        const vec3 color = max(isThrough ? through : reflected, vec3(0.0f));
        const float density = isSmoothBase ? 1.0f : isRough && !bsdf.isSmooth ? facets.density : 0.0f;
        const float passed = isSmoothBase ? 1.0f : facets.passage;
        value = color * (density * passed * radianceScale * bsdf.baseScale);
        pdf = bsdf.pBase * (isThrough ? 1.0f - colors.share : colors.share) *
              (isSmoothBase ? 1.0f : density * bsdf.sampled.density);
        const float leftIn = bsdf.isRefractive ? 1.0f : diffusePart(bsdf, facetAlbedo(cosIn, alphaIn));
        left = bsdf.isSingleScatter ? 1.0f - colors.cover : bsdf.diffuseOut * leftIn;
        if (hasFeature(kFeatureSheen) && isComputed(largest(bsdf.sheenColor) > 0.0f)) {
            const float sheen = sheenLobe(bsdf.wo.z, cosIn, facets.normal.z, bsdf.sheenRoughness);
            value = value + bsdf.sheenColor * (isRough && !isThrough ? sheen : 0.0f);
        }
    }
    const float cosineDensity = isRough ? cosIn * kInvPi : 0.0f;
    const vec3 diffuse = isThrough ? bsdf.diffuseThroughColor : bsdf.diffuseColor;
    value = value + diffuse * (cosineDensity * left * radianceScale * bsdf.baseScale);
    pdf = pdf + (isThrough ? bsdf.pDiffuseThrough : bsdf.pDiffuse) * cosineDensity;

    if (hasFeature(kFeatureCoat) && isComputed(bsdf.coat.strength > 0.0f)) {
        const CoatLobe coat = coatLobe(bsdf.coat, wi, lobe == kLobeSmoothCoat);
        const bool isCoat = !isThrough && !isSmoothBase;
        value = value + vec3(isCoat ? coat.value : 0.0f);
        pdf = pdf + (isCoat ? bsdf.pCoat * coat.density : 0.0f);
    }

    // Both normals must agree on which side wi lies, otherwise light would leak through the surface.
    const float geometricCosine = dotProduct(wi, bsdf.frame.geometricNormal);
    const bool isOneSide = incoming.z * geometricCosine > 0.0f;
    const bool isLit = isOneSide && lobe != kLobeNone;
    return BsdfValue(isLit ? value : vec3(0.0f), isLit ? pdf : 0.0f);
}

SHARED_FN BsdfValue evalBsdf(const Bsdf bsdf, const vec3 wi) {
    return evaluateDirection(bsdf, wi, kLobeRough);
}

// `uLobe` chooses the lobe, `uDirection` the direction in it. All are in [0, 1).
SHARED_FN BsdfDirection sampleDirection(const Bsdf bsdf, const float uLobe, const vec2 uDirection) {
    const float toDiffuse = bsdf.pBase + bsdf.pDiffuse;
    const float toThrough = toDiffuse + bsdf.pDiffuseThrough;
    const bool isBase = uLobe < bsdf.pBase;
    const bool isCoat = hasFeature(kFeatureCoat) && uLobe >= toThrough && bsdf.pCoat > 0.0f;
    const bool isCosine = !isBase && !isCoat;
    const bool isSmooth = isCoat ? bsdf.coat.isSmooth : bsdf.isSmooth;

    vec3 wo = bsdf.wo;
    vec2 alpha = bsdf.alpha;
    Basis around = Basis(bsdf.frame.tangent, bsdf.frame.bitangent);
    vec3 normal = bsdf.frame.normal;
    FacetBound among = bsdf.sampled;
    if (isCoat) {
        wo = bsdf.coat.wo;
        alpha = vec2(bsdf.coat.alpha, bsdf.coat.alpha);
        around = bsdf.coat.around;
        normal = bsdf.coat.normal;
        among = bsdf.coat.sampled;
    }
    vec3 mirrored = vec3(0.0f);
    vec3 passed = vec3(0.0f);
    bool isThrough = false;
    if (hasFeature(kFeatureFacets | kFeatureCoat) && isComputed(!isCosine)) {
        const vec3 facet = isSmooth ? vec3(0.0f, 0.0f, 1.0f) : sampleFacet(wo, alpha, among, uDirection);
        const float facetOut = dotProduct(wo, facet);
        const Refraction refraction = refractionAt(facetOut, bsdf.eta);
        const vec3 refracted = facet * (facetOut / bsdf.eta - refraction.cosine) - wo / bsdf.eta;
        mirrored = facet * (2.0f * facetOut) - wo;
        passed = bsdf.isRefractive ? refracted : vec3(mirrored.x, mirrored.y, -mirrored.z);
        isThrough = isBase && uLobe >= bsdf.pBase * facetColors(bsdf, max(facetOut, 0.0f)).share;
    }

    const vec2 circle = circlePoint(uDirection.x);
    const float radius = sqrt(uDirection.y);
    const float height = sqrt(1.0f - uDirection.y);
    const vec3 cosine = vec3(circle.x * radius, circle.y * radius, uLobe < toDiffuse ? height : -height);

    const vec3 local = isCosine ? cosine : isThrough ? passed : mirrored;
    const vec3 wi = unitVector(around.tangent * local.x + around.bitangent * local.y + normal * local.z);
    // A facet may reflect light into the surface that it belongs to. No other lobe may claim such a sample.
    const bool isAbove = local.z > 0.0f && dotProduct(wi, bsdf.frame.normal) > 0.0f;
    const bool isLost = isCosine ? toThrough == 0.0f : isThrough ? local.z >= 0.0f : !isAbove;
    const uint smoothLobe = isCoat ? kLobeSmoothCoat : kLobeSmoothBase;
    return BsdfDirection(wi, isLost ? kLobeNone : isSmooth && !isCosine ? smoothLobe : kLobeRough);
}

// Combines a direction and its value to a sample.
SHARED_FN BsdfSample makeSample(const Bsdf bsdf, const BsdfDirection direction, const BsdfValue found) {
    const bool isDelta = direction.lobe == kLobeSmoothBase || direction.lobe == kLobeSmoothCoat;
    const bool isThrough = dotProduct(direction.wi, bsdf.frame.normal) < 0.0f;
    const vec3 weight = found.pdf > 0.0f ? found.value / found.pdf : vec3(0.0f);
    const uint flags = (isDelta ? kSampleDelta : 0u) | (isThrough ? kSampleTransmitted : 0u);
    return BsdfSample(direction.wi, isDelta ? 1.0f : found.pdf, weight, flags,
                      radianceScaleOf(bsdf, isThrough));
}

SHARED_FN BsdfSample sampleBsdf(const Bsdf bsdf, const float uLobe, const vec2 uDirection) {
    const BsdfDirection direction = sampleDirection(bsdf, uLobe, uDirection);
    return makeSample(bsdf, direction, evaluateDirection(bsdf, direction.wi, direction.lobe));
}

SHARED_END
#endif
