// SPDX-License-Identifier: MIT
// The input of bsdf.h at the point that a ray hit: the glTF 2.0 material with all textures looked up, and the
// directions of the surface.
#ifndef METAMARCH_SHARED_SURFACE_H
#define METAMARCH_SHARED_SURFACE_H
#include "math.h"

SHARED_BEGIN

// Values of SurfaceMaterial::flags.
const uint kSurfaceVolume = 1u;
// Follows glTF 2.0, Appendix B, to the letter; otherwise energy is preserved.
const uint kSurfaceSingleScatter = 2u;

// The parameters of glTF 2.0 and its extensions, factor times texture, with linear colours. Emission, alpha,
// KHR_materials_unlit and the interior of volumes are not part of the BSDF.
struct SurfaceMaterial {
    vec3 baseColor;
    float metallic;
    vec3 specularColor; // KHR_materials_specular; may exceed 1
    float specular;
    vec3 sheenColor; // KHR_materials_sheen; black: no sheen
    float sheenRoughness;
    vec3 diffuseTransmissionColor; // KHR_materials_diffuse_transmission
    float diffuseTransmission;
    float roughness; // perceptual roughness; alpha is its square
    // KHR_materials_ior, dispersed if the path has chosen a channel, divided by that of the volume around; 0:
    // infinite.
    float ior;
    float transmission;         // KHR_materials_transmission
    float anisotropy;           // KHR_materials_anisotropy, strength along SurfaceFrame::tangent
    float coat;                 // KHR_materials_clearcoat
    float coatRoughness;        // perceptual roughness
    float iridescence;          // KHR_materials_iridescence
    float iridescenceIor;       // index of refraction of the film
    float iridescenceThickness; // nanometres
    uint flags;
    uint padding0;
    uint padding1;
};

// Smallest cosine that bendNormal leaves between the mirrored ray and the geometric normal; if 0.9 of wo's
// cosine is less, that counts.
const float kLeastMirrorCosine = 0.01f;
// A tangent whose squared length after projection is below this gives no direction.
const float kLeastTangent = 1e-8f;

// The directions at the hit, made by makeSurfaceFrame. tangent, bitangent and normal are orthonormal.
struct SurfaceFrame {
    vec3 normal; // shading normal
    uint isBack; // 1 if the ray hit the back of the triangle: the inside, if the surface bounds a volume
    vec3 tangent;
    uint padding0;
    vec3 bitangent;
    uint padding1;
    vec3 coatNormal;
    uint padding2;
    vec3 geometricNormal;
    uint padding3;
};

// Flips a normal to the side of `geometricNormal` and tilts it just enough for the mirror direction of `wo`
// to stay above the surface; then wo is above the normal too. Changes nothing on a flat surface. A. Keller et
// al., "The Iray Light Transport Simulation and Rendering System", 2017, appendix.
SHARED_FN vec3 bendNormal(const vec3 normal, const vec3 geometricNormal, const vec3 wo) {
    const vec3 turned = dotProduct(normal, geometricNormal) < 0.0f ? -normal : normal;
    const vec3 mirrored = turned * (2.0f * dotProduct(wo, turned)) - wo;
    const float least = min(0.9f * dotProduct(wo, geometricNormal), kLeastMirrorCosine);
    const float lift = least - dotProduct(mirrored, geometricNormal);
    const vec3 halfVector = wo + unitVector(mirrored + geometricNormal * max(lift, 0.0f));
    const bool isBent = lift > 0.0f && dotProduct(halfVector, halfVector) > 1e-12f;
    return isBent ? unitVector(halfVector) : turned;
}

// `facing` is the geometric normal on the side that was hit, and `tangent` is perpendicular to `normal`.
SHARED_FN SurfaceFrame frameOf(const bool isBack, const vec3 facing, const vec3 normal, const vec3 tangent,
                               const vec3 coatNormal) {
    return SurfaceFrame(normal, isBack ? 1u : 0u, tangent, 0u, crossProduct(normal, tangent), 0u, coatNormal,
                        0u, facing, 0u);
}

// Returns what makeSurfaceFrame returns for a flat surface without normal maps or tangents.
SHARED_FN SurfaceFrame makeFlatFrame(const vec3 geometricNormal, const vec3 wo) {
    const bool isBack = dotProduct(geometricNormal, wo) < 0.0f;
    const vec3 facing = isBack ? -geometricNormal : geometricNormal;
    return frameOf(isBack, facing, facing, basisAround(facing).tangent, facing);
}

// All vectors have unit length. `wo` points to where the ray came from; `geometricNormal` points out of the
// triangle's front. `tangent` is the direction of greatest anisotropic roughness and may be zero.
SHARED_FN SurfaceFrame makeSurfaceFrame(const vec3 geometricNormal, const vec3 shadingNormal,
                                        const vec3 coatNormal, const vec3 tangent, const vec3 wo) {
    const bool isBack = dotProduct(geometricNormal, wo) < 0.0f;
    const vec3 facing = isBack ? -geometricNormal : geometricNormal;
    const vec3 normal = bendNormal(shadingNormal, facing, wo);
    const vec3 projected = tangent - normal * dotProduct(tangent, normal);
    const vec3 along = dotProduct(projected, projected) > kLeastTangent ? unitVector(projected)
                                                                        : basisAround(normal).tangent;
    return frameOf(isBack, facing, normal, along, bendNormal(coatNormal, facing, wo));
}

// KHR_materials_dispersion: a path that meets a dispersive volume chooses one of the three channels with
// equal probability and keeps it. channelMask multiplies the path's throughput: three times the chosen
// channel, zero for the others.
SHARED_FN float dispersedIor(const float ior, const float dispersion, const uint channel) {
    const float halfSpread = (ior - 1.0f) * 0.025f * dispersion;
    return max(ior + (float(channel) - 1.0f) * halfSpread, 1.0f);
}

SHARED_FN vec3 channelMask(const uint channel) {
    return vec3(channel == 0u ? 3.0f : 0.0f, channel == 1u ? 3.0f : 0.0f, channel == 2u ? 3.0f : 0.0f);
}

SHARED_ASSERT_SIZE(SurfaceMaterial, 112)
SHARED_ASSERT_OFFSET(SurfaceMaterial, metallic, 12)
SHARED_ASSERT_OFFSET(SurfaceMaterial, specularColor, 16)
SHARED_ASSERT_OFFSET(SurfaceMaterial, specular, 28)
SHARED_ASSERT_OFFSET(SurfaceMaterial, sheenColor, 32)
SHARED_ASSERT_OFFSET(SurfaceMaterial, sheenRoughness, 44)
SHARED_ASSERT_OFFSET(SurfaceMaterial, diffuseTransmissionColor, 48)
SHARED_ASSERT_OFFSET(SurfaceMaterial, diffuseTransmission, 60)
SHARED_ASSERT_OFFSET(SurfaceMaterial, roughness, 64)
SHARED_ASSERT_OFFSET(SurfaceMaterial, ior, 68)
SHARED_ASSERT_OFFSET(SurfaceMaterial, flags, 100)
SHARED_ASSERT_SIZE(SurfaceFrame, 80)
SHARED_ASSERT_OFFSET(SurfaceFrame, tangent, 16)
SHARED_ASSERT_OFFSET(SurfaceFrame, bitangent, 32)
SHARED_ASSERT_OFFSET(SurfaceFrame, coatNormal, 48)
SHARED_ASSERT_OFFSET(SurfaceFrame, geometricNormal, 64)

SHARED_END
#endif
