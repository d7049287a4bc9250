// SPDX-License-Identifier: MIT
// The glTF 2.0 material as a BSDF, prepared for one hit: everything that depends on the direction to the eye,
// `wo`, but not on the direction to the light. bsdf.h evaluates and samples it.
//
// The base is a mix, in the proportions of glTF, of metal, dielectric over diffuse, and glass. Thin glass has
// the mirrored lobe of KHR_materials_transmission; for glass with a volume see B. Walter et al., "Microfacet
// Models for Refraction through Rough Surfaces", 2007. The sheen is over the base, and the coat over the
// sheen. As in the Khronos texts, each layer receives the light that the layers above do not reflect towards
// wo. This preserves energy exactly but is not reciprocal.
//
// By default the base preserves energy. Its facets are balanced (facetBalance), with the colour that light
// acquires in further reflections. The diffuse lobe receives the light that the dielectric's facets do not
// reflect, in both directions (C. Kulla, A. Conty, "Revisiting Physically Based Shading at Imageworks",
// 2017). Both are reciprocal. Rough glass is divided by its albedo (E. Turquin, "Practical Multiple
// Scattering Compensation for Microfacet Models", 2019), which is not reciprocal. With kSurfaceSingleScatter
// the base follows glTF 2.0, Appendix B, exactly.
#ifndef METAMARCH_SHARED_BSDF_MODEL_H
#define METAMARCH_SHARED_BSDF_MODEL_H
#include "coat.h"
#include "features.h"
#include "iridescence.h"
#include "sheen.h"
#include "surface.h"

SHARED_BEGIN

// The least ior of a refracting surface: between nearly equal media, the half vector of wo and wi would
// cancel.
const float kMinVolumeIor = 1.001f;
const float kSchlickMean = 0.0476190476f; // 1/21, the mean of Schlick's weight over a uniformly lit surface

// The reflectance of a facet depends on the angle; it goes from `low` at normal to `high` at grazing
// incidence.
struct Reflectance {
    vec3 low;
    vec3 high;
};

struct Bsdf {
    SurfaceFrame frame;
    vec3 wo; // in the coordinates of `frame`
    bool isSingleScatter;

    // The facets of the base.
    bool hasFacets; // otherwise the base is diffuse
    vec2 alpha;
    float meanAlpha; // a mean of both: see alphaTowards
    float lengthOut; // facetLength of wo
    FacetBound sampled;
    float balanceOut;
    bool isSmooth;     // the lobes of the facets are deltas
    bool isRefractive; // the surface bounds a transparent volume
    float eta;         // refractive index beyond the surface, divided by that on the side of wo
    float trueEta;     // the same without the limit kMinVolumeIor
    float etaF0;       // reflectance at normal incidence of an interface with this eta
    float metallic;
    Reflectance metal;
    Reflectance dielectric;
    Film film;
    vec3 throughColor;
    float dielectricGain; // compensates the energy that rough glass loses by single scattering
    float throughGain;
    vec3 multiple; // colour of the light that the balance adds
    float multipleThrough;

    // The diffuse lobes: their colours, and the largest channel of the reflectance of the dielectric above
    // them.
    vec3 diffuseColor;
    vec3 diffuseThroughColor;
    float coverLow;
    float coverHigh;
    float coverMultiple;
    // Fraction of the light that the facets leave for the diffuse lobes, towards wo. If the fraction for wi
    // is a factor too, this one is divided by its mean over all directions.
    float diffuseOut;

    float baseScale; // fraction of the light that the layers above the base transmit
    vec3 sheenColor; // scaled by the coat
    float sheenRoughness;
    Coat coat;

    float pBase; // the p… are the probabilities of sampling the lobes
    float pDiffuse;
    float pDiffuseThrough;
    float pCoat;

    // For the integrator:
    vec3 albedo;         // an estimate, for the channel `albedo`
    float emissionScale; // fraction of the emission that the coat transmits
    bool isDelta;        // no lobe is rough, so light sampling finds nothing
};

// The reflectance and transmittance of facets at one angle.
struct FacetColors {
    vec3 reflected;
    vec3 through;
    vec3 dielectric; // reflectance of the dielectric alone
    float cover;     // largest channel of `dielectric`
    float share;     // probability of reflection when sampling chooses between reflection and transmission
};

SHARED_FN vec3 atWeight(const Reflectance reflectance, const float weight) {
    return reflectance.low + (reflectance.high - reflectance.low) * weight;
}

// Uses Schlick's approximation. For refraction it uses Fresnel's equations, stretched to the same end points:
// only they have a critical angle and no reflection between equal media.
SHARED_FN vec3 dielectricReflectance(const Bsdf bsdf, const Refraction refraction, const float cosine) {
    const float exact = (refraction.reflectance - bsdf.etaF0) / (1.0f - bsdf.etaF0);
    const float weight = bsdf.isRefractive ? exact : schlickWeight(cosine);
    return max(atWeight(bsdf.dielectric, weight), vec3(0.0f));
}

// Returns 1 for total internal reflection, where no light is transmitted, whatever the material or film.
SHARED_FN vec3 orTotal(const Bsdf bsdf, const Refraction refraction, const vec3 reflectance) {
    return bsdf.isRefractive && refraction.cosine == 0.0f ? vec3(1.0f) : reflectance;
}

SHARED_FN FacetColors facetColors(const Bsdf bsdf, const float cosine) {
    const Refraction refraction = refractionAt(cosine, bsdf.eta);
    vec3 dielectric = dielectricReflectance(bsdf, refraction, cosine);
    vec3 metal = atWeight(bsdf.metal, schlickWeight(cosine));
    if (hasFeature(kFeatureIridescence) && isComputed(bsdf.film.strength > 0.0f)) {
        // One film serves both bases, because materials between metal and dielectric are rare.
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

// Returns the colour of the light that facets reflect more than once. `whole` is their mean albedo for the
// Fresnel term 1.
SHARED_FN vec3 multipleReflectance(const Reflectance reflectance, const float whole) {
    const vec3 mean = atWeight(reflectance, kSchlickMean);
    return mean * mean * whole / (vec3(1.0f) - mean * (1.0f - whole));
}

SHARED_FN vec3 facetReflection(const Reflectance reflectance, const vec3 multiple, const FacetAlbedo facets) {
    return reflectance.low * (facets.whole - facets.grazing) + reflectance.high * facets.grazing +
           multiple * (1.0f - facets.whole);
}

// Returns the fraction of the light that the dielectric's facets leave for the diffuse lobes, for one
// direction or for the mean over all directions, as `facets` is.
SHARED_FN float diffusePart(const Bsdf bsdf, const FacetAlbedo facets) {
    const float covered = bsdf.coverLow * (facets.whole - facets.grazing) + bsdf.coverHigh * facets.grazing +
                          bsdf.coverMultiple * (1.0f - facets.whole);
    return max(1.0f - covered, 0.0f);
}

// Applies the film to a reflectance as facetColors does, at the single angle whose Schlick weight is the mean
// over the facets.
SHARED_FN Reflectance underMeanFilm(const Bsdf bsdf, const Reflectance reflectance,
                                    const FacetAlbedo facets) {
    const float cosine = 1.0f - power(max(facets.grazing / facets.whole, 1e-12f), 0.2f);
    const vec3 base = blend3(bsdf.dielectric.low, bsdf.metal.low, bsdf.metallic);
    const vec3 filmed = filmReflectance(cosine, bsdf.film.ior, bsdf.film.thickness, base);
    return Reflectance(underFilm(bsdf.film, reflectance.low, filmed),
                       underFilm(bsdf.film, reflectance.high, filmed));
}

// Returns the alpha of isotropic facets that replace anisotropic ones in albedos, for the direction w. At
// grazing angles it is the alpha in the plane of w, at the normal a mean of both alphas. Of the formulas that
// were tried, this one preserves the energy of metals best: within 7 % up to strength 0.5. At strength 1, up
// to 12 % are gained if wo is tilted along the rougher axis, and up to 43 % are lost if it is tilted across
// it.
SHARED_FN float alphaTowards(const Bsdf bsdf, const vec3 w) {
    const float x = w.x * bsdf.alpha.x;
    const float y = w.y * bsdf.alpha.y;
    const float z = w.z * bsdf.meanAlpha;
    return sqrt(x * x + y * y + z * z);
}

// Returns true if the base reflects or refracts, or there is sheen.
SHARED_FN bool baseHasFacets(const SurfaceMaterial material) {
    const float strength =
        max(max(material.metallic, material.specular), max(material.transmission, material.iridescence));
    return hasFeature(kFeatureFacets) && isComputed(strength > 0.0f || largest(material.sheenColor) > 0.0f);
}

// Sets the members that follow from the material without an albedo.
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
    bsdf.hasFacets = baseHasFacets(material);
    if (bsdf.hasFacets) {
        bsdf.balanceOut = facetBalance(local.z, alphaTowards(bsdf, local));
    }
    bsdf.isSmooth = along <= kMinAlpha;

    const bool isVolume = (material.flags & kSurfaceVolume) != 0u;
    const float transmission = hasFeature(kFeatureTransmission) ? material.transmission : 0.0f;
    const bool isRefractive =
        hasFeature(kFeatureVolume) && isVolume && transmission > 0.0f && material.ior > 0.0f;
    // Seen from a denser volume around this one, its surface is that of the denser one seen from inside.
    const bool isInverted = isVolume && material.ior > 0.0f && material.ior < 1.0f;
    const float trueIor = isInverted ? 1.0f / material.ior : material.ior;
    const float ior = max(trueIor, isRefractive ? kMinVolumeIor : 1.0f);
    const float etaF0 = material.ior > 0.0f ? normalReflectance(ior) : 1.0f;
    bsdf.isRefractive = isRefractive;
    bsdf.sampled = kAllFacets;
    if (!isRefractive) {
        bsdf.sampled = mirroringFacets(local, bsdf.alpha, bsdf.lengthOut);
    }
    const bool isDenser = isVolume && (frame.isBack != 0u) != isInverted; // on the side of wo
    bsdf.eta = isDenser ? 1.0f / ior : ior;
    bsdf.trueEta = isDenser ? 1.0f / trueIor : trueIor;
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

// Sets the remaining members where nothing but diffuse lobes exists, to the bits that makeBsdf would compute.
SHARED_FN Bsdf diffuseBsdf(const Bsdf plain) {
    Bsdf bsdf = plain;
    const vec3 albedo = plain.diffuseColor + plain.diffuseThroughColor;
    const float whole = luminance(albedo);
    const float perLobe = whole > 0.0f ? 1.0f / whole : 0.0f;
    const float pDiffuse = luminance(plain.diffuseColor) * perLobe;
    const float pDiffuseThrough = luminance(plain.diffuseThroughColor) * perLobe;
    bsdf.coverLow = 0.0f;
    bsdf.coverHigh = 0.0f;
    bsdf.coverMultiple = 0.0f;
    bsdf.diffuseOut = 1.0f;
    bsdf.dielectricGain = 1.0f;
    bsdf.throughGain = 1.0f;
    bsdf.multiple = vec3(0.0f);
    bsdf.multipleThrough = 0.0f;
    bsdf.baseScale = 1.0f;
    bsdf.sheenColor = vec3(0.0f);
    bsdf.sheenRoughness = 1.0f;
    bsdf.coat.strength = 0.0f;
    bsdf.coat.albedo = 0.0f;
    bsdf.coat.isSmooth = true;
    bsdf.pBase = 0.0f;
    bsdf.pDiffuse = pDiffuse;
    bsdf.pDiffuseThrough = pDiffuseThrough;
    bsdf.pCoat = 0.0f;
    bsdf.albedo = albedo;
    bsdf.emissionScale = 1.0f;
    bsdf.isDelta = pDiffuse == 0.0f && pDiffuseThrough == 0.0f;
    return bsdf;
}

// Call it once per hit. `wo` has unit length, is in world space and points away from the surface.
SHARED_FN Bsdf makeBsdf(const SurfaceMaterial material, const SurfaceFrame frame, const vec3 wo) {
    const Bsdf plain = plainBsdf(material, frame, wo);
    const bool isInside = (material.flags & kSurfaceVolume) != 0u && frame.isBack != 0u;
    const bool hasCoat = hasFeature(kFeatureCoat) && isComputed(material.coat > 0.0f && !isInside);
    if (!plain.hasFacets && !hasCoat) {
        return diffuseBsdf(plain);
    }
    Bsdf bsdf = plain;
    const float cosOut = bsdf.wo.z;
    const float dielectricPart = 1.0f - bsdf.metallic;

    // Find the light that the facets reflect, and the light that they leave for the diffuse lobes.
    const float alphaOut = alphaTowards(bsdf, bsdf.wo);
    // Without facets both are multiplied by 0.
    FacetAlbedo facets = FacetAlbedo(1.0f, 0.0f);
    FacetAlbedo meanFacets = FacetAlbedo(1.0f, 0.0f);
    if (bsdf.hasFacets) {
        facets = facetAlbedo(cosOut, alphaOut);
        meanFacets = meanFacetAlbedo(bsdf.meanAlpha);
    }
    Reflectance metal = bsdf.metal;
    Reflectance dielectric = bsdf.dielectric;
    if (hasFeature(kFeatureIridescence) && isComputed(bsdf.film.strength > 0.0f)) {
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

    // Give back the energy that facets shadow.
    const bool isCompensated = !bsdf.isSingleScatter && !bsdf.isSmooth;
    float glassGain = 1.0f;
    float glassPart = 0.0f;
    if (hasFeature(kFeatureVolume)) {
        const bool isDenser = bsdf.eta < 1.0f; // on the side of wo
        const float ior = isDenser ? 1.0f / bsdf.eta : bsdf.eta;
        const float gain = 1.0f / glassAlbedo(cosOut, alphaOut, ior, isDenser);
        glassGain = isCompensated && bsdf.isRefractive ? gain : 1.0f;
        glassPart = bsdf.isRefractive ? material.transmission : 0.0f;
    }
    bsdf.dielectricGain = blend(1.0f, glassGain, glassPart);
    bsdf.throughGain = glassGain;
    bsdf.multiple =
        (metalMultiple * bsdf.metallic + dielectricMultiple * (dielectricPart * (1.0f - glassPart))) *
        (isCompensated ? 1.0f : 0.0f);
    bsdf.multipleThrough = isCompensated && !bsdf.isRefractive ? 1.0f - bsdf.coverMultiple : 0.0f;

    // Add the layers above the base. They are on the outside of a volume.
    float coatScale = 1.0f;
    bsdf.coat.strength = 0.0f;
    bsdf.coat.albedo = 0.0f;
    bsdf.coat.isSmooth = true;
    if (hasCoat) {
        const float alpha = max(squared(material.coatRoughness), kMinAlpha);
        bsdf.coat =
            makeCoat(frame.coatNormal, isInside ? 0.0f : material.coat, alpha, bsdf.isSingleScatter, wo);
        coatScale = 1.0f - bsdf.coat.albedo;
    }
    float sheen = 0.0f;
    bsdf.sheenColor = vec3(0.0f);
    bsdf.sheenRoughness = 1.0f;
    if (hasFeature(kFeatureSheen) && isComputed(largest(material.sheenColor) > 0.0f && !isInside)) {
        bsdf.sheenColor = isInside ? vec3(0.0f) : material.sheenColor * coatScale;
        bsdf.sheenRoughness = max(material.sheenRoughness, kMinSheenRoughness);
        sheen = sheenAlbedo(cosOut, bsdf.sheenRoughness);
    }
    bsdf.baseScale = coatScale - largest(bsdf.sheenColor) * sheen;
    bsdf.emissionScale = coatScale;

    // Sample each lobe in proportion to its brightness.
    const vec3 fromDielectric =
        bsdf.isRefractive ? atNormal.dielectric : facetReflection(dielectric, dielectricMultiple, facets);
    const vec3 fromMetal = facetReflection(metal, metalMultiple, facets);
    const vec3 through = bsdf.throughColor * (1.0f - largest(fromDielectric));
    const vec3 base =
        (fromMetal * bsdf.metallic + fromDielectric * dielectricPart + through) * bsdf.baseScale;
    // With single scattering, the mix depends on the facet of each wi, and some facets always leave light for
    // the diffuse lobes; therefore they keep a probability.
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
