// The glTF 2.0 material as a BSDF: evaluated, and sampled by one lobe of the mixture. makeBsdf prepares, once
// per hit, all that depends on the direction to the eye, `wo`; every direction is of unit length, in world
// space, and points away from the surface.
//
// The base is metal, dielectric over diffuse, and glass (thin: the mirrored lobe of
// KHR_materials_transmission; with a volume: Walter et al., "Microfacet Models for Refraction through Rough
// Surfaces", 2007), mixed as glTF says. Sheen lies over it, the coat over that; each layer below is given
// what the one above does not reflect towards wo, which is the layering of the Khronos texts: exact in
// energy, not reciprocal.
//
// By default the base preserves energy. Its facets are balanced (facetBalance), with the colour that light
// takes on in further reflections; diffuse light is what the dielectric's facets leave in both directions (C.
// Kulla, A. Conty, "Revisiting Physically Based Shading at Imageworks", 2017). Both are reciprocal. Rough
// glass is divided by its albedo (E. Turquin, "Practical Multiple Scattering Compensation for Microfacet
// Models", 2019), which is not. With kSurfaceSingleScatter the base is Appendix B to the letter.
//
// Lobes whose alpha is at most kMinAlpha are deltas: evalBsdf does not see them, sampleBsdf marks them.
//
// A driver that runs both sides of a branch pays for the features a scene does not use. A kernel may define
// BSDF_FEATURES, for instance as a specialization constant; without a feature, its parameters count as
// absent.
#ifndef METAMARCH_SHARED_BSDF_H
#define METAMARCH_SHARED_BSDF_H
#include "shared/albedo.h"
#include "shared/fresnel.h"
#include "shared/iridescence.h"
#include "shared/microfacet.h"
#include "shared/sheen.h"
#include "shared/surface.h"

SHARED_BEGIN

const uint kFeatureCoat = 1u;
const uint kFeatureSheen = 2u;
const uint kFeatureTransmission = 4u;
const uint kFeatureVolume = 8u; // refraction; wants kFeatureTransmission
const uint kFeatureIridescence = 16u;
const uint kFeatureDiffuseTransmission = 32u;
const uint kAllFeatures = 63u;
#ifndef BSDF_FEATURES
#define BSDF_FEATURES kAllFeatures
#endif

SHARED_FN bool hasFeature(const uint feature) { return (BSDF_FEATURES & feature) != 0u; }

// Of perceptual roughness 0.01. Nearer to 0 the half vector has too few bits for the distribution.
const float kMinAlpha = 1e-4f;
// Refraction between nearly equal media: the half vector of wo and wi would cancel.
const float kMinVolumeIor = 1.001f;
const float kMinCosine = 1e-6f; // of wo to a normal, where rounding would make it 0
const float kCoatF0 = 0.04f;    // of ior 1.5

// What BsdfDirection::lobe and evaluateDirection know: the smooth lobes are evaluated one at a time.
const uint kLobeRough = 0u; // the mixture of all that are no deltas
const uint kLobeSmoothBase = 1u;
const uint kLobeSmoothCoat = 2u;
const uint kLobeNone = 3u; // the surface is black

// BsdfSample::flags.
const uint kSampleDelta = 1u;
const uint kSampleTransmitted = 2u;

struct Bsdf {
    SurfaceFrame frame;
    vec3 wo; // in the frame
    float lengthOut;
    vec2 alpha;
    float meanAlpha; // of the isotropic facets that stand in for anisotropic ones in albedos
    float balanceOut;
    bool isSingleScatter;
    bool isBaseSmooth;
    bool isRefractive; // bounds a volume that lets light in
    float eta;         // refractive index beyond the surface, in units of that on the side of wo
    float etaF0;       // and its reflectance at normal incidence

    float metallic;
    vec3 metalF0;
    vec3 dielectricF0;
    float dielectricF90;
    float filmStrength;
    float filmIor;
    float filmThickness;
    float dielectricGain; // compensation of rough glass
    float throughGain;
    vec3 multiple; // colour of what the balance adds to reflection
    float multipleThrough;

    vec3 throughColor; // of the facets' transmission
    vec3 diffuseColor;
    vec3 diffuseThroughColor;
    // What the dielectric's facets reflect: largest channel at normal incidence, at grazing, and in further
    // reflections. Diffuse light is what is left.
    float coverF0;
    float coverF90;
    float coverMultiple;
    float diffuseOut; // left towards wo, over the mean of all directions

    float baseScale; // the layers above the base let through
    vec3 sheenColor; // scaled by the coat
    float sheenRoughness;
    vec3 coatOut; // wo around the coat's normal
    float coatStrength;
    float coatAlpha;
    bool isCoatSmooth;

    float pBase; // probabilities of the lobes
    float pDiffuse;
    float pDiffuseThrough;
    float pCoat;

    // For the kernel:
    vec3 albedo;         // estimated, for the picture of that name
    float emissionScale; // the coat lies over the emission, too
    bool isDelta;        // no lobe is rough: light sampling cannot help
};

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
    float pdf;   // 1 for a delta, where it says nothing: other ways to find wi do not exist
    vec3 weight; // BSDF times |cosine| over pdf; 0: the path ends
    uint flags;
    float radianceScale; // contained in weight: radiance grows with the square of the refractive index
};

// How facets at one angle reflect and transmit.
struct FacetColors {
    vec3 reflected;
    vec3 through;
    float cover; // largest channel of the dielectric's reflectance
    float share; // of reflection, when one of the two is chosen
};

// (1 - c)^5-weighted from f0 to f90, or by Fresnel's equations stretched to the same ends.
SHARED_FN vec3 dielectricReflectance(const Bsdf bsdf, const float cosine) {
    const Refraction refraction = refractionAt(cosine, bsdf.eta);
    const float weight = bsdf.isRefractive ? (refraction.reflectance - bsdf.etaF0) / (1.0f - bsdf.etaF0)
                                           : schlickWeight(cosine);
    const vec3 partial = bsdf.dielectricF0 + (vec3(bsdf.dielectricF90) - bsdf.dielectricF0) * weight;
    const bool isTotal = bsdf.isRefractive && refraction.cosine == 0.0f;
    return isTotal ? vec3(1.0f) : max(partial, vec3(0.0f));
}

SHARED_FN FacetColors facetColors(const Bsdf bsdf, const float cosine) {
    vec3 dielectric = dielectricReflectance(bsdf, cosine);
    vec3 metal = bsdf.metalF0 + (vec3(1.0f) - bsdf.metalF0) * schlickWeight(cosine);
    if (hasFeature(kFeatureIridescence)) {
        // One film for both bases: materials between metal and dielectric are rare.
        const vec3 film = filmReflectance(cosine, bsdf.filmIor, bsdf.filmThickness,
                                          blend3(bsdf.dielectricF0, bsdf.metalF0, bsdf.metallic));
        dielectric = bsdf.filmStrength > 0.0f ? blend3(dielectric, film, bsdf.filmStrength) : dielectric;
        metal = bsdf.filmStrength > 0.0f ? blend3(metal, film, bsdf.filmStrength) : metal;
    }
    const float cover = largest(dielectric);
    const vec3 reflected =
        metal * bsdf.metallic + dielectric * ((1.0f - bsdf.metallic) * bsdf.dielectricGain);
    const vec3 through = bsdf.throughColor * ((1.0f - cover) * bsdf.throughGain);
    const float reflectedPart = luminance(reflected);
    const float whole = reflectedPart + luminance(through);
    return FacetColors(reflected, through, cover, whole > 0.0f ? reflectedPart / whole : 0.0f);
}

// The colour of light that facets reflect more than once, from their mean reflectance; `whole` is the mean
// albedo for the Fresnel term 1.
SHARED_FN vec3 multipleReflectance(const vec3 mean, const float whole) {
    return mean * mean * whole / (vec3(1.0f) - mean * (1.0f - whole));
}

// What the dielectric's facets leave for diffuse light, towards one direction.
SHARED_FN float diffusePart(const Bsdf bsdf, const FacetAlbedo facets) {
    const float covered = bsdf.coverF0 * (facets.whole - facets.grazing) + bsdf.coverF90 * facets.grazing +
                          bsdf.coverMultiple * (1.0f - facets.whole);
    return max(1.0f - covered, 0.0f);
}

SHARED_FN Bsdf makeBsdf(const SurfaceMaterial material, const SurfaceFrame frame, const vec3 wo) {
    Bsdf bsdf;
    bsdf.frame = frame;
    const vec3 wLocal = vec3(dotProduct(wo, frame.tangent), dotProduct(wo, frame.bitangent),
                             max(dotProduct(wo, frame.normal), kMinCosine));
    const bool isVolume = (material.flags & kSurfaceVolume) != 0u;
    const bool isSingleScatter = (material.flags & kSurfaceSingleScatter) != 0u;
    const bool isInside = isVolume && frame.isBack != 0u;

    const float alpha = material.roughness * material.roughness;
    const float alphaAlong = max(blend(alpha, 1.0f, squared(material.anisotropy)), kMinAlpha);
    const float alphaAcross = max(alpha, kMinAlpha);
    const float meanAlpha =
        0.25f * (alphaAlong + alphaAcross) + 0.5f * sqrt(0.5f * (squared(alphaAlong) + squared(alphaAcross)));
    const bool isBaseSmooth = alphaAlong <= kMinAlpha;
    const vec2 alphas = vec2(alphaAlong, alphaAcross);
    bsdf.wo = wLocal;
    bsdf.alpha = alphas;
    bsdf.meanAlpha = meanAlpha;
    bsdf.lengthOut = facetLength(wLocal, alphas);
    bsdf.isSingleScatter = isSingleScatter;
    bsdf.isBaseSmooth = isBaseSmooth;

    const float transmission = hasFeature(kFeatureTransmission) ? material.transmission : 0.0f;
    const bool isRefractive =
        hasFeature(kFeatureVolume) && isVolume && transmission > 0.0f && material.ior > 0.0f;
    const float ior = isRefractive ? max(material.ior, kMinVolumeIor) : max(material.ior, 1.0f);
    const float etaF0 = material.ior > 0.0f ? normalReflectance(ior) : 1.0f;
    bsdf.isRefractive = isRefractive;
    bsdf.eta = isInside ? 1.0f / ior : ior;
    bsdf.etaF0 = etaF0;

    const float dielectricPart = 1.0f - material.metallic;
    const vec3 dielectricF0 = min(material.specularColor * etaF0, vec3(1.0f)) * material.specular;
    bsdf.metallic = material.metallic;
    bsdf.metalF0 = material.baseColor;
    bsdf.dielectricF0 = dielectricF0;
    bsdf.dielectricF90 = material.specular;
    bsdf.throughColor = material.baseColor * (dielectricPart * transmission);
    const float diffuseThrough =
        hasFeature(kFeatureDiffuseTransmission) ? material.diffuseTransmission : 0.0f;
    const float diffuse = dielectricPart * (1.0f - transmission);
    bsdf.diffuseColor = material.baseColor * (diffuse * (1.0f - diffuseThrough));
    bsdf.diffuseThroughColor = material.diffuseTransmissionColor * (diffuse * diffuseThrough);

    // Albedos. The film counts as it reflects at the angle at which Schlick's weight is the facets' mean.
    const FacetAlbedo facets = facetAlbedo(wLocal.z, meanAlpha);
    const float filmStrength = hasFeature(kFeatureIridescence) ? material.iridescence : 0.0f;
    bsdf.filmStrength = filmStrength;
    bsdf.filmIor = max(material.iridescenceIor, 1.0f);
    bsdf.filmThickness = material.iridescenceThickness;
    vec3 metalLow = material.baseColor;
    vec3 metalHigh = vec3(1.0f);
    vec3 dielectricLow = dielectricF0;
    vec3 dielectricHigh = vec3(material.specular);
    if (hasFeature(kFeatureIridescence)) {
        const float cosine = 1.0f - power(max(facets.grazing / facets.whole, 1e-12f), 0.2f);
        const vec3 film = filmReflectance(cosine, bsdf.filmIor, bsdf.filmThickness,
                                          blend3(dielectricF0, material.baseColor, material.metallic));
        metalLow = filmStrength > 0.0f ? blend3(metalLow, film, filmStrength) : metalLow;
        metalHigh = filmStrength > 0.0f ? blend3(metalHigh, film, filmStrength) : metalHigh;
        dielectricLow = filmStrength > 0.0f ? blend3(dielectricLow, film, filmStrength) : dielectricLow;
        dielectricHigh = filmStrength > 0.0f ? blend3(dielectricHigh, film, filmStrength) : dielectricHigh;
    }
    const FacetAlbedo meanFacets = meanFacetAlbedo(meanAlpha);
    const float schlickMean = 1.0f / 21.0f; // of Schlick's weight over all directions
    const vec3 metalMultiple =
        multipleReflectance(blend3(metalLow, metalHigh, schlickMean), meanFacets.whole);
    const vec3 dielectricMultiple =
        multipleReflectance(blend3(dielectricLow, dielectricHigh, schlickMean), meanFacets.whole);
    bsdf.coverF0 = largest(dielectricLow);
    bsdf.coverF90 = largest(dielectricHigh);
    bsdf.coverMultiple = largest(dielectricMultiple);
    const float diffuseHere = diffusePart(bsdf, facets);
    bsdf.diffuseOut = diffuseHere / max(diffusePart(bsdf, meanFacets), 1e-3f);

    // Compensation of what facets shadow.
    const bool isCompensated = !isSingleScatter && !isBaseSmooth;
    const float glassPart = isRefractive ? transmission : 0.0f;
    float glassGain = 1.0f;
    if (hasFeature(kFeatureVolume)) {
        const float gain = 1.0f / glassAlbedo(wLocal.z, meanAlpha, ior, isInside);
        glassGain = isCompensated && isRefractive ? gain : 1.0f;
    }
    bsdf.balanceOut = facetBalance(wLocal.z, meanAlpha);
    bsdf.dielectricGain = blend(1.0f, glassGain, glassPart);
    bsdf.throughGain = glassGain;
    bsdf.multiple =
        (metalMultiple * material.metallic + dielectricMultiple * (dielectricPart * (1.0f - glassPart))) *
        (isCompensated ? 1.0f : 0.0f);
    bsdf.multipleThrough = isCompensated && !isRefractive ? 1.0f - bsdf.coverMultiple : 0.0f;

    // Layers. They lie on the outside of a volume.
    float coatAlbedo = 0.0f;
    bsdf.coatOut = vec3(0.0f, 0.0f, 1.0f);
    bsdf.coatStrength = 0.0f;
    bsdf.coatAlpha = 1.0f;
    bsdf.isCoatSmooth = true;
    if (hasFeature(kFeatureCoat)) {
        const Basis around = basisAround(frame.coatNormal);
        const vec3 coatOut = vec3(dotProduct(wo, around.tangent), dotProduct(wo, around.bitangent),
                                  max(dotProduct(wo, frame.coatNormal), kMinCosine));
        const float coatAlpha = max(squared(material.coatRoughness), kMinAlpha);
        const bool isCoatSmooth = coatAlpha <= kMinAlpha;
        const FacetAlbedo coatFacets = facetAlbedo(coatOut.z, coatAlpha);
        const float roughAlbedo = kCoatF0 * (coatFacets.whole - coatFacets.grazing) + coatFacets.grazing;
        const float smoothAlbedo = blend(kCoatF0, 1.0f, schlickWeight(coatOut.z));
        const float strength = isInside ? 0.0f : material.coat;
        coatAlbedo = strength * (isSingleScatter || isCoatSmooth ? smoothAlbedo : roughAlbedo);
        bsdf.coatOut = coatOut;
        bsdf.coatStrength = strength;
        bsdf.coatAlpha = coatAlpha;
        bsdf.isCoatSmooth = isCoatSmooth;
    }
    const float coatScale = 1.0f - coatAlbedo;
    float sheen = 0.0f;
    bsdf.sheenColor = vec3(0.0f);
    bsdf.sheenRoughness = 1.0f;
    if (hasFeature(kFeatureSheen)) {
        const float roughness = max(material.sheenRoughness, kMinSheenRoughness);
        sheen = isInside ? 0.0f : sheenAlbedo(wLocal.z, roughness);
        bsdf.sheenColor = isInside ? vec3(0.0f) : material.sheenColor * coatScale;
        bsdf.sheenRoughness = roughness;
    }
    const float baseScale = coatScale * (1.0f - largest(material.sheenColor) * sheen);
    bsdf.baseScale = baseScale;
    bsdf.emissionScale = coatScale;

    // Each lobe as likely as it is bright.
    const vec3 fittedDielectric = dielectricLow * (facets.whole - facets.grazing) +
                                  dielectricHigh * facets.grazing +
                                  dielectricMultiple * (1.0f - facets.whole);
    const vec3 dielectric = isRefractive ? dielectricReflectance(bsdf, wLocal.z) : fittedDielectric;
    const vec3 metal = metalLow * (facets.whole - facets.grazing) + metalHigh * facets.grazing +
                       metalMultiple * (1.0f - facets.whole);
    const vec3 base = (metal * material.metallic + dielectric * dielectricPart +
                       bsdf.throughColor * (1.0f - largest(dielectric))) *
                      baseScale;
    const vec3 diffuseAlbedo = bsdf.diffuseColor * (diffuseHere * baseScale) + bsdf.sheenColor * sheen;
    const vec3 diffuseThroughAlbedo = bsdf.diffuseThroughColor * (diffuseHere * baseScale);
    bsdf.albedo = base + diffuseAlbedo + diffuseThroughAlbedo + vec3(coatAlbedo);
    const float whole = luminance(bsdf.albedo);
    const float perLobe = whole > 0.0f ? 1.0f / whole : 0.0f;
    bsdf.pBase = luminance(base) * perLobe;
    bsdf.pDiffuse = luminance(diffuseAlbedo) * perLobe;
    bsdf.pDiffuseThrough = luminance(diffuseThroughAlbedo) * perLobe;
    bsdf.pCoat = coatAlbedo * perLobe;
    bsdf.isDelta = (isBaseSmooth || bsdf.pBase == 0.0f) && (bsdf.isCoatSmooth || bsdf.pCoat == 0.0f) &&
                   bsdf.pDiffuse == 0.0f && bsdf.pDiffuseThrough == 0.0f;
    return bsdf;
}

// The BSDF of one of the smooth lobes towards the one direction it has, or of all rough ones. evalBsdf and
// sampleBsdf are made of this; a kernel that calls it in a loop over the light's direction and the sampled
// one has it compiled once.
SHARED_FN BsdfValue evaluateDirection(const Bsdf bsdf, const vec3 wi, const uint lobe) {
    const vec3 incoming = vec3(dotProduct(wi, bsdf.frame.tangent), dotProduct(wi, bsdf.frame.bitangent),
                               dotProduct(wi, bsdf.frame.normal));
    const float cosIn = abs(incoming.z);
    const bool isThrough = incoming.z < 0.0f;
    const bool isRefracted = isThrough && bsdf.isRefractive;
    // Both normals must agree on the side, or light would leak through the surface.
    const float geometricCosine = dotProduct(wi, bsdf.frame.geometricNormal);
    const bool isSeen = isThrough ? geometricCosine < 0.0f : geometricCosine > 0.0f && cosIn > 0.0f;
    const bool isRough = lobe == kLobeRough;
    const bool isSmoothBase = lobe == kLobeSmoothBase;

    // The facets that send wi to wo: by reflection, by refraction, or through a thin wall, where the lobe is
    // the reflected one mirrored at the surface.
    const float eta = isRefracted ? bsdf.eta : 1.0f;
    const vec3 folded = vec3(incoming.x, incoming.y, isRefracted ? incoming.z : cosIn);
    const vec3 sum = bsdf.wo + folded * eta;
    const vec3 between = unitVector(sum.z < 0.0f ? -sum : sum);
    const vec3 facet = isSmoothBase ? vec3(0.0f, 0.0f, 1.0f) : between;
    const float facetOut = dotProduct(bsdf.wo, facet);
    const float facetIn = dotProduct(folded, facet);
    const bool isFacing = facetOut > 0.0f && (!isRefracted || facetIn < 0.0f);
    const FacetColors colors = facetColors(bsdf, max(facetOut, 0.0f));

    const float bend = facetOut + eta * facetIn;
    const float spread = isRefracted ? 4.0f * facetOut * eta * eta * abs(facetIn) / (bend * bend) : 1.0f;
    const float rough = mirrorDensity(facet, bsdf.wo.z, bsdf.lengthOut, bsdf.alpha) * spread;
    const float passage = facetPassage(bsdf.wo.z, bsdf.lengthOut, cosIn, facetLength(incoming, bsdf.alpha),
                                       bsdf.isSingleScatter && isThrough);
    const bool isRoughBase = isRough && !bsdf.isBaseSmooth && isFacing;
    const float density = isSmoothBase ? 1.0f : isRoughBase ? rough : 0.0f;
    const float passed = isSmoothBase ? 1.0f : passage;
    const float balance = bsdf.balanceOut * facetBalance(cosIn, bsdf.meanAlpha) - 1.0f;
    const vec3 reflected = colors.reflected + bsdf.multiple * balance;
    const vec3 through = colors.through + bsdf.throughColor * (bsdf.multipleThrough * balance);
    const vec3 color = max(isThrough ? through : reflected, vec3(0.0f));
    const float radianceScale = 1.0f / (eta * eta);
    vec3 value = color * (density * passed * radianceScale * bsdf.baseScale);
    float pdf = bsdf.pBase * (isThrough ? 1.0f - colors.share : colors.share) * density;

    // Diffuse light, both ways, and sheen.
    const float cosineDensity = isRough ? cosIn * kInvPi : 0.0f;
    const float covered = bsdf.diffuseOut * diffusePart(bsdf, facetAlbedo(cosIn, bsdf.meanAlpha));
    const float left = bsdf.isSingleScatter ? 1.0f - colors.cover : covered;
    const vec3 diffuse = isThrough ? bsdf.diffuseThroughColor : bsdf.diffuseColor;
    value = value + diffuse * (cosineDensity * left * radianceScale * bsdf.baseScale);
    pdf = pdf + (isThrough ? bsdf.pDiffuseThrough : bsdf.pDiffuse) * cosineDensity;
    if (hasFeature(kFeatureSheen)) {
        const float sheen = sheenLobe(bsdf.wo.z, cosIn, between.z, bsdf.sheenRoughness);
        value = value + bsdf.sheenColor * (isRough && !isThrough ? sheen : 0.0f);
    }

    if (hasFeature(kFeatureCoat)) {
        const Basis around = basisAround(bsdf.frame.coatNormal);
        const float coatIn = dotProduct(wi, bsdf.frame.coatNormal);
        const vec3 coatWi = vec3(dotProduct(wi, around.tangent), dotProduct(wi, around.bitangent), coatIn);
        const vec3 coatFacet = unitVector(bsdf.coatOut + vec3(coatWi.x, coatWi.y, abs(coatIn)));
        const vec2 alpha = vec2(bsdf.coatAlpha, bsdf.coatAlpha);
        const float lengthOut = facetLength(bsdf.coatOut, alpha);
        const float roughCoat = mirrorDensity(coatFacet, bsdf.coatOut.z, lengthOut, alpha);
        const float coatPassage =
            facetPassage(bsdf.coatOut.z, lengthOut, abs(coatIn), facetLength(coatWi, alpha), false);
        const bool isSmoothCoat = lobe == kLobeSmoothCoat;
        const bool isCoatSeen = !isThrough && coatIn > 0.0f;
        const bool isRoughCoat = isRough && !bsdf.isCoatSmooth && isCoatSeen;
        const float coatDensity = isSmoothCoat ? 1.0f : isRoughCoat ? roughCoat : 0.0f;
        const float cosine = bsdf.isSingleScatter ? bsdf.coatOut.z : dotProduct(bsdf.coatOut, coatFacet);
        const float fresnel = blend(kCoatF0, 1.0f, schlickWeight(cosine));
        value = value + vec3(bsdf.coatStrength * fresnel * coatDensity * (isSmoothCoat ? 1.0f : coatPassage));
        pdf = pdf + bsdf.pCoat * coatDensity;
    }
    const bool isLit = isSeen && lobe != kLobeNone;
    return BsdfValue(isLit ? value : vec3(0.0f), isLit ? pdf : 0.0f);
}

SHARED_FN BsdfValue evalBsdf(const Bsdf bsdf, const vec3 wi) {
    return evaluateDirection(bsdf, wi, kLobeRough);
}

// Draws the lobe by uLobe, the direction in it by uDirection; each in [0, 1).
SHARED_FN BsdfDirection sampleDirection(const Bsdf bsdf, const float uLobe, const vec2 uDirection) {
    const float toDiffuse = bsdf.pBase + bsdf.pDiffuse;
    const float toThrough = toDiffuse + bsdf.pDiffuseThrough;
    const bool isNone = toThrough + bsdf.pCoat == 0.0f;
    const bool isBase = uLobe < bsdf.pBase;
    const bool isCoat = hasFeature(kFeatureCoat) && bsdf.pCoat > 0.0f && uLobe >= toThrough;
    const bool isCosine = !isBase && !isCoat;
    const bool isSmooth = isCoat ? bsdf.isCoatSmooth : bsdf.isBaseSmooth;

    const vec3 wo = isCoat ? bsdf.coatOut : bsdf.wo;
    const vec2 alpha = isCoat ? vec2(bsdf.coatAlpha, bsdf.coatAlpha) : bsdf.alpha;
    const vec3 facet = isSmooth ? vec3(0.0f, 0.0f, 1.0f) : sampleFacet(wo, alpha, uDirection);
    const float facetOut = dotProduct(wo, facet);
    const FacetColors colors = facetColors(bsdf, max(facetOut, 0.0f));
    const bool isThrough = isBase && uLobe >= bsdf.pBase * colors.share;

    const vec3 mirrored = facet * (2.0f * facetOut) - wo;
    const Refraction refraction = refractionAt(facetOut, bsdf.eta);
    const vec3 refracted = facet * (facetOut / bsdf.eta - refraction.cosine) - wo / bsdf.eta;
    const vec3 straight = vec3(mirrored.x, mirrored.y, -mirrored.z);
    const vec3 passed = bsdf.isRefractive ? refracted : straight;

    const vec2 circle = circlePoint(uDirection.x);
    const float radius = sqrt(uDirection.y);
    const float height = sqrt(max(1.0f - uDirection.y, 0.0f));
    const vec3 cosine = vec3(circle.x * radius, circle.y * radius, uLobe < toDiffuse ? height : -height);
    const vec3 local = isCosine ? cosine : isThrough ? passed : mirrored;

    vec3 tangent = bsdf.frame.tangent;
    vec3 bitangent = bsdf.frame.bitangent;
    vec3 normal = bsdf.frame.normal;
    if (hasFeature(kFeatureCoat)) {
        const Basis around = basisAround(bsdf.frame.coatNormal);
        tangent = isCoat ? around.tangent : tangent;
        bitangent = isCoat ? around.bitangent : bitangent;
        normal = isCoat ? bsdf.frame.coatNormal : normal;
    }
    const vec3 wi = unitVector(tangent * local.x + bitangent * local.y + normal * local.z);
    const uint smoothLobe = isCoat ? kLobeSmoothCoat : kLobeSmoothBase;
    // A facet may send light back into the surface it belongs to; then nothing else may claim the sample.
    const bool isAbove = local.z > 0.0f && dotProduct(wi, bsdf.frame.normal) > 0.0f;
    const bool isLost = !isCosine && (isThrough ? local.z >= 0.0f : !isAbove);
    const uint roughLobe = isNone || isLost ? kLobeNone : kLobeRough;
    const uint lobe = isSmooth && !isCosine && !isLost ? smoothLobe : roughLobe;
    return BsdfDirection(wi, lobe);
}

// The sample that `direction` makes with the value evaluateDirection found for it.
SHARED_FN BsdfSample makeSample(const Bsdf bsdf, const BsdfDirection direction, const BsdfValue found) {
    const bool isDelta = direction.lobe != kLobeRough;
    const bool isThrough = dotProduct(direction.wi, bsdf.frame.normal) < 0.0f;
    const float scale = isThrough && bsdf.isRefractive ? 1.0f / (bsdf.eta * bsdf.eta) : 1.0f;
    const vec3 weight = found.pdf > 0.0f ? found.value / found.pdf : vec3(0.0f);
    return BsdfSample(direction.wi, isDelta ? 1.0f : found.pdf, weight,
                      (isDelta ? kSampleDelta : 0u) | (isThrough ? kSampleTransmitted : 0u), scale);
}

SHARED_FN BsdfSample sampleBsdf(const Bsdf bsdf, const float uLobe, const vec2 uDirection) {
    const BsdfDirection direction = sampleDirection(bsdf, uLobe, uDirection);
    return makeSample(bsdf, direction, evaluateDirection(bsdf, direction.wi, direction.lobe));
}

SHARED_END
#endif
