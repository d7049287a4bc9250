// SPDX-License-Identifier: MIT
// The glTF 2.0 material as a BSDF, prepared for one hit: all that depends on the direction to the eye, `wo`,
// and not on the light's. bsdf.h evaluates and samples it.
//
// The base is metal, dielectric over diffuse, and glass (thin: the mirrored lobe of
// KHR_materials_transmission; with a volume: B. Walter et al., "Microfacet Models for Refraction through
// Rough Surfaces", 2007), mixed as glTF says. Sheen lies over it, the coat over that; each layer below is
// given what the one above does not reflect towards wo, as the Khronos texts layer: exact in energy, not
// reciprocal.
//
// By default the base preserves energy. Its facets are balanced (facetBalance), with the colour that light
// takes on in further reflections; diffuse light is what the dielectric's facets leave in both directions (C.
// Kulla, A. Conty, "Revisiting Physically Based Shading at Imageworks", 2017). Both are reciprocal. Rough
// glass is divided by its albedo (E. Turquin, "Practical Multiple Scattering Compensation for Microfacet
// Models", 2019), which is not. With kSurfaceSingleScatter the base is Appendix B of glTF 2.0 to the letter.
#ifndef METAMARCH_SHARED_BSDF_MODEL_H
#define METAMARCH_SHARED_BSDF_MODEL_H
#include "coat.h"
#include "features.h"
#include "iridescence.h"
#include "sheen.h"
#include "surface.h"

SHARED_BEGIN

// Refraction between nearly equal media: the half vector of wo and wi would cancel.
const float kMinVolumeIor = 1.001f;
const float kSchlickMean = 0.0476190476f; // 1/21, the mean of Schlick's weight over a uniformly lit surface

// The reflectance of a facet by its angle, between `low` at normal incidence and `high` at grazing.
struct Reflectance {
    vec3 low;
    vec3 high;
};

struct Bsdf {
    SurfaceFrame frame;
    vec3 wo; // in the frame
    bool isSingleScatter;

    // The base's facets.
    vec2 alpha;
    float
        meanAlpha; // of the isotropic facets that stand in for anisotropic ones in albedos: see alphaTowards
    float lengthOut; // facetLength of wo
    float balanceOut;
    bool isSmooth;     // their lobes are deltas
    bool isRefractive; // the surface bounds a volume that lets light in
    float eta;         // refractive index beyond the surface, in units of that on the side of wo
    float etaF0;       // its reflectance at normal incidence
    float metallic;
    Reflectance metal;
    Reflectance dielectric;
    Film film;
    vec3 throughColor;
    float dielectricGain; // of rough glass
    float throughGain;
    vec3 multiple; // colour of what the balance adds
    float multipleThrough;

    // Diffuse light: both colours, and the dielectric above it by its largest channel.
    vec3 diffuseColor;
    vec3 diffuseThroughColor;
    float coverLow;
    float coverHigh;
    float coverMultiple;
    float diffuseOut; // left towards wo; over the mean of all directions where wi counts, too

    float baseScale; // what the layers above the base let through
    vec3 sheenColor; // scaled by the coat
    float sheenRoughness;
    Coat coat;

    float pBase; // probabilities of the lobes
    float pDiffuse;
    float pDiffuseThrough;
    float pCoat;

    // For the kernel:
    vec3 albedo;         // estimated, for the picture of that name
    float emissionScale; // the coat lies over the emission, too
    bool isDelta;        // no lobe is rough: light sampling cannot help
};

// How facets at one angle reflect and transmit.
struct FacetColors {
    vec3 reflected;
    vec3 through;
    vec3 dielectric; // its reflectance alone
    float cover;     // the largest channel of that
    float share;     // of reflection, when one of the two is chosen
};

SHARED_FN vec3 atWeight(const Reflectance reflectance, const float weight) {
    return reflectance.low + (reflectance.high - reflectance.low) * weight;
}

// By Schlick, or for refraction by Fresnel's equations stretched to the same ends: only they know the
// critical angle, and that equal media do not reflect.
SHARED_FN vec3 dielectricReflectance(const Bsdf bsdf, const Refraction refraction, const float cosine) {
    const float exact = (refraction.reflectance - bsdf.etaF0) / (1.0f - bsdf.etaF0);
    const float weight = bsdf.isRefractive ? exact : schlickWeight(cosine);
    return max(atWeight(bsdf.dielectric, weight), vec3(0.0f));
}

// Nothing passes where Snell's law has no solution, whatever the material or a film says.
SHARED_FN vec3 orTotal(const Bsdf bsdf, const Refraction refraction, const vec3 reflectance) {
    return bsdf.isRefractive && refraction.cosine == 0.0f ? vec3(1.0f) : reflectance;
}

SHARED_FN FacetColors facetColors(const Bsdf bsdf, const float cosine) {
    const Refraction refraction = refractionAt(cosine, bsdf.eta);
    vec3 dielectric = dielectricReflectance(bsdf, refraction, cosine);
    vec3 metal = atWeight(bsdf.metal, schlickWeight(cosine));
    if (hasFeature(kFeatureIridescence)) {
        // One film for both bases: materials between metal and dielectric are rare.
        const vec3 base = blend3(bsdf.dielectric.low, bsdf.metal.low, bsdf.metallic);
        const vec3 filmed = filmReflectance(cosine, bsdf.film.ior, bsdf.film.thickness, base);
        dielectric = underFilm(bsdf.film, dielectric, filmed);
        metal = underFilm(bsdf.film, metal, filmed);
    }
    dielectric = orTotal(bsdf, refraction, dielectric);
    const float cover = largest(dielectric);
    const vec3 reflected =
        metal * bsdf.metallic + dielectric * ((1.0f - bsdf.metallic) * bsdf.dielectricGain);
    const vec3 through = bsdf.throughColor * ((1.0f - cover) * bsdf.throughGain);
    const float reflectedPart = luminance(reflected);
    const float whole = reflectedPart + luminance(through);
    return FacetColors(reflected, through, dielectric, cover, whole > 0.0f ? reflectedPart / whole : 0.0f);
}

// The colour of light that facets reflect more than once; `whole` is their mean albedo for the Fresnel
// term 1.
SHARED_FN vec3 multipleReflectance(const Reflectance reflectance, const float whole) {
    const vec3 mean = atWeight(reflectance, kSchlickMean);
    return mean * mean * whole / (vec3(1.0f) - mean * (1.0f - whole));
}

SHARED_FN vec3 facetReflection(const Reflectance reflectance, const vec3 multiple, const FacetAlbedo facets) {
    return reflectance.low * (facets.whole - facets.grazing) + reflectance.high * facets.grazing +
           multiple * (1.0f - facets.whole);
}

// What the dielectric's facets leave for diffuse light, towards one direction or in the mean.
SHARED_FN float diffusePart(const Bsdf bsdf, const FacetAlbedo facets) {
    const float covered = bsdf.coverLow * (facets.whole - facets.grazing) + bsdf.coverHigh * facets.grazing +
                          bsdf.coverMultiple * (1.0f - facets.whole);
    return max(1.0f - covered, 0.0f);
}

// The film as facetColors lays it over a reflectance, at the one angle at which Schlick's weight is the
// facets' mean.
SHARED_FN Reflectance underMeanFilm(const Bsdf bsdf, const Reflectance reflectance,
                                    const FacetAlbedo facets) {
    const float cosine = 1.0f - power(max(facets.grazing / facets.whole, 1e-12f), 0.2f);
    const vec3 base = blend3(bsdf.dielectric.low, bsdf.metal.low, bsdf.metallic);
    const vec3 filmed = filmReflectance(cosine, bsdf.film.ior, bsdf.film.thickness, base);
    return Reflectance(underFilm(bsdf.film, reflectance.low, filmed),
                       underFilm(bsdf.film, reflectance.high, filmed));
}

// For one direction, isotropic facets stand in for anisotropic ones: as rough as these in its own plane at
// grazing angles, and a mean of both alphas at the normal, which of those tried keeps metals' energy best:
// within 7 % up to strength 0.5; at strength 1 as much as 12 % is made where wo leans along the grooves'
// roughness, and 43 % lost across it.
SHARED_FN float alphaTowards(const Bsdf bsdf, const vec3 w) {
    const float x = w.x * bsdf.alpha.x;
    const float y = w.y * bsdf.alpha.y;
    const float z = w.z * bsdf.meanAlpha;
    return sqrt(x * x + y * y + z * z);
}

// Everything that the material says by itself, without an albedo.
SHARED_FN Bsdf plainBsdf(const SurfaceMaterial material, const SurfaceFrame frame, const vec3 wo) {
    Bsdf bsdf;
    const vec3 local = vec3(dotProduct(wo, frame.tangent), dotProduct(wo, frame.bitangent),
                            max(dotProduct(wo, frame.normal), kMinCosine));
    bsdf.frame = frame;
    bsdf.wo = local;
    bsdf.isSingleScatter = (material.flags & kSurfaceSingleScatter) != 0u;

    const float alpha = material.roughness * material.roughness;
    const float along = max(blend(alpha, 1.0f, squared(material.anisotropy)), kMinAlpha);
    const float across = max(alpha, kMinAlpha);
    bsdf.alpha = vec2(along, across);
    bsdf.meanAlpha = 0.25f * along + 0.75f * across;
    bsdf.lengthOut = facetLength(local, vec2(along, across));
    bsdf.balanceOut = 1.0f;
    if (hasFeature(kFeatureFacets)) {
        bsdf.balanceOut = facetBalance(local.z, alphaTowards(bsdf, local));
    }
    bsdf.isSmooth = along <= kMinAlpha;

    const bool isVolume = (material.flags & kSurfaceVolume) != 0u;
    const float transmission = hasFeature(kFeatureTransmission) ? material.transmission : 0.0f;
    const bool isRefractive =
        hasFeature(kFeatureVolume) && isVolume && transmission > 0.0f && material.ior > 0.0f;
    const float ior = max(material.ior, isRefractive ? kMinVolumeIor : 1.0f);
    const float etaF0 = material.ior > 0.0f ? normalReflectance(ior) : 1.0f;
    bsdf.isRefractive = isRefractive;
    bsdf.eta = isVolume && frame.isBack != 0u ? 1.0f / ior : ior;
    bsdf.etaF0 = etaF0;

    const vec3 dielectricF0 = min(material.specularColor * etaF0, vec3(1.0f)) * material.specular;
    bsdf.metallic = material.metallic;
    bsdf.metal = Reflectance(material.baseColor, vec3(1.0f));
    bsdf.dielectric = Reflectance(dielectricF0, vec3(material.specular));
    bsdf.film = Film(hasFeature(kFeatureIridescence) ? material.iridescence : 0.0f,
                     max(material.iridescenceIor, 1.0f), material.iridescenceThickness);

    const float diffuseThrough =
        hasFeature(kFeatureDiffuseTransmission) ? material.diffuseTransmission : 0.0f;
    const float dielectricPart = 1.0f - material.metallic;
    const float diffuse = dielectricPart * (1.0f - transmission);
    bsdf.throughColor = material.baseColor * (dielectricPart * transmission);
    bsdf.diffuseColor = material.baseColor * (diffuse * (1.0f - diffuseThrough));
    bsdf.diffuseThroughColor = material.diffuseTransmissionColor * (diffuse * diffuseThrough);
    return bsdf;
}

// Once per hit; of unit length: wo, in world space, away from the surface.
SHARED_FN Bsdf makeBsdf(const SurfaceMaterial material, const SurfaceFrame frame, const vec3 wo) {
    Bsdf bsdf = plainBsdf(material, frame, wo);
    const float cosOut = bsdf.wo.z;
    const float dielectricPart = 1.0f - bsdf.metallic;
    const bool isInside = (material.flags & kSurfaceVolume) != 0u && frame.isBack != 0u;

    // What the facets reflect, and leave for diffuse light.
    const float alphaOut = alphaTowards(bsdf, bsdf.wo);
    // Without kFeatureFacets both are multiplied by 0.
    FacetAlbedo facets = FacetAlbedo(1.0f, 0.0f);
    FacetAlbedo meanFacets = FacetAlbedo(1.0f, 0.0f);
    if (hasFeature(kFeatureFacets)) {
        facets = facetAlbedo(cosOut, alphaOut);
        meanFacets = meanFacetAlbedo(bsdf.meanAlpha);
    }
    Reflectance metal = bsdf.metal;
    Reflectance dielectric = bsdf.dielectric;
    if (hasFeature(kFeatureIridescence)) {
        metal = underMeanFilm(bsdf, metal, facets);
        dielectric = underMeanFilm(bsdf, dielectric, facets);
    }
    const vec3 metalMultiple = multipleReflectance(metal, meanFacets.whole);
    const vec3 dielectricMultiple = multipleReflectance(dielectric, meanFacets.whole);
    bsdf.coverLow = largest(dielectric.low);
    bsdf.coverHigh = largest(dielectric.high);
    bsdf.coverMultiple = largest(dielectricMultiple);
    const FacetColors atNormal = facetColors(bsdf, cosOut); // as if the surface were smooth
    const float diffuseHere = bsdf.isRefractive ? 1.0f - atNormal.cover : diffusePart(bsdf, facets);
    bsdf.diffuseOut =
        bsdf.isRefractive ? diffuseHere : diffuseHere / max(diffusePart(bsdf, meanFacets), 1e-3f);

    // What they shadow is given back.
    const bool isCompensated = !bsdf.isSingleScatter && !bsdf.isSmooth;
    float glassGain = 1.0f;
    float glassPart = 0.0f;
    if (hasFeature(kFeatureVolume)) {
        const float ior = isInside ? 1.0f / bsdf.eta : bsdf.eta;
        const float gain = 1.0f / glassAlbedo(cosOut, alphaOut, ior, isInside);
        glassGain = isCompensated && bsdf.isRefractive ? gain : 1.0f;
        glassPart = bsdf.isRefractive ? material.transmission : 0.0f;
    }
    bsdf.dielectricGain = blend(1.0f, glassGain, glassPart);
    bsdf.throughGain = glassGain;
    bsdf.multiple =
        (metalMultiple * bsdf.metallic + dielectricMultiple * (dielectricPart * (1.0f - glassPart))) *
        (isCompensated ? 1.0f : 0.0f);
    bsdf.multipleThrough = isCompensated && !bsdf.isRefractive ? 1.0f - bsdf.coverMultiple : 0.0f;

    // The layers, which lie on the outside of a volume.
    float coatScale = 1.0f;
    bsdf.coat.albedo = 0.0f;
    bsdf.coat.isSmooth = true;
    if (hasFeature(kFeatureCoat)) {
        const float alpha = max(squared(material.coatRoughness), kMinAlpha);
        bsdf.coat =
            makeCoat(frame.coatNormal, isInside ? 0.0f : material.coat, alpha, bsdf.isSingleScatter, wo);
        coatScale = 1.0f - bsdf.coat.albedo;
    }
    float sheen = 0.0f;
    bsdf.sheenColor = vec3(0.0f);
    bsdf.sheenRoughness = 1.0f;
    if (hasFeature(kFeatureSheen)) {
        bsdf.sheenColor = isInside ? vec3(0.0f) : material.sheenColor * coatScale;
        bsdf.sheenRoughness = max(material.sheenRoughness, kMinSheenRoughness);
        sheen = sheenAlbedo(cosOut, bsdf.sheenRoughness);
    }
    bsdf.baseScale = coatScale - largest(bsdf.sheenColor) * sheen;
    bsdf.emissionScale = coatScale;

    // Each lobe is as likely as it is bright.
    const vec3 fromDielectric =
        bsdf.isRefractive ? atNormal.dielectric : facetReflection(dielectric, dielectricMultiple, facets);
    const vec3 fromMetal = facetReflection(metal, metalMultiple, facets);
    const vec3 through = bsdf.throughColor * (1.0f - largest(fromDielectric));
    const vec3 base =
        (fromMetal * bsdf.metallic + fromDielectric * dielectricPart + through) * bsdf.baseScale;
    // Single scatter mixes by the facet that each wi has: some of them always leave diffuse light a part.
    const float diffuseScale = (bsdf.isSingleScatter ? max(diffuseHere, 0.1f) : diffuseHere) * bsdf.baseScale;
    const vec3 diffuse = bsdf.diffuseColor * diffuseScale + bsdf.sheenColor * sheen;
    const vec3 diffuseThrough = bsdf.diffuseThroughColor * diffuseScale;
    const vec3 albedo = base + diffuse + diffuseThrough + vec3(bsdf.coat.albedo);
    const float whole = luminance(albedo);
    const float perLobe = whole > 0.0f ? 1.0f / whole : 0.0f;
    bsdf.albedo = albedo;
    bsdf.pBase = luminance(base) * perLobe;
    bsdf.pDiffuse = luminance(diffuse) * perLobe;
    bsdf.pDiffuseThrough = luminance(diffuseThrough) * perLobe;
    bsdf.pCoat = bsdf.coat.albedo * perLobe;
    bsdf.isDelta = (bsdf.isSmooth || bsdf.pBase == 0.0f) && (bsdf.coat.isSmooth || bsdf.pCoat == 0.0f) &&
                   bsdf.pDiffuse == 0.0f && bsdf.pDiffuseThrough == 0.0f;
    return bsdf;
}

SHARED_END
#endif
