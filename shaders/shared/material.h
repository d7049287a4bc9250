// SPDX-License-Identifier: MIT
// Makes the input of the BSDF at a hit: interpolates vertex attributes and looks up textures.
#ifndef METAMARCH_SHARED_MATERIAL_H
#define METAMARCH_SHARED_MATERIAL_H
#include "surface.h"
#include "texture.h"

SHARED_BEGIN

SHARED_FN vec3 xyz(const vec4 v) { return vec3(v.x, v.y, v.z); }

// Returns log2 of the side of a square that has `part` times twice the triangle's area in texture
// coordinates. The square's area is clamped to the domain of logarithm().
const float kLeastSeen = 1.0e-30f;
const float kMostSeen = 1.0e30f;
SHARED_FN float levelOf(const vec2 a, const vec2 b, const vec2 c, const float part) {
    const vec2 e1 = b - a;
    const vec2 e2 = c - a;
    const float seen = abs(e1.x * e2.y - e1.y * e2.x) * part;
    // Comparisons map NaN to kLeastSeen; min and max of some drivers would not.
    const float bounded = seen > kLeastSeen ? (seen < kMostSeen ? seen : kMostSeen) : kLeastSeen;
    return logarithm(bounded) * 0.721347520444f; // 1 / (2 ln 2)
}

// `part` is the area of the footprint, as a fraction of twice the triangle's area; 0 for a point. `uLevel` is
// TexturePoint::uLevel.
SHARED_FN TexturePoint texturePoint(SCENE_PARAMETER const Surface surface, const vec3 weights,
                                    const float part, const float uLevel) {
    TexturePoint point = TexturePoint(vec2(0.0f), vec2(0.0f), vec2(0.0f), vec2(0.0f), kFinestLevel,
                                      kFinestLevel, kFinestLevel, kFinestLevel, uLevel);
    if (!hasFeature(SCENE kFeatureTextures)) {
        return point;
    }
    const bool hasLevels = hasFeature(SCENE kFeatureMipmaps) && part > 0.0f;
    const Vertex a = loadVertex(SCENE surface.vertex0);
    const Vertex b = loadVertex(SCENE surface.vertex1);
    const Vertex c = loadVertex(SCENE surface.vertex2);
    point.first = vec2(a.u0, a.v0) * weights.x + vec2(b.u0, b.v0) * weights.y + vec2(c.u0, c.v0) * weights.z;
    point.second = vec2(a.u1, a.v1) * weights.x + vec2(b.u1, b.v1) * weights.y + vec2(c.u1, c.v1) * weights.z;
    if (hasLevels) {
        point.firstLevel = levelOf(vec2(a.u0, a.v0), vec2(b.u0, b.v0), vec2(c.u0, c.v0), part);
        point.secondLevel = levelOf(vec2(a.u1, a.v1), vec2(b.u1, b.v1), vec2(c.u1, c.v1), part);
    }
    if (!hasFeature(SCENE kFeatureFurtherSets)) {
        return point;
    }
    const Vertex d = loadVertex(SCENE a.further);
    const Vertex e = loadVertex(SCENE b.further);
    const Vertex f = loadVertex(SCENE c.further);
    point.third = vec2(d.u0, d.v0) * weights.x + vec2(e.u0, e.v0) * weights.y + vec2(f.u0, f.v0) * weights.z;
    point.fourth = vec2(d.u1, d.v1) * weights.x + vec2(e.u1, e.v1) * weights.y + vec2(f.u1, f.v1) * weights.z;
    if (hasLevels) {
        point.thirdLevel = levelOf(vec2(d.u0, d.v0), vec2(e.u0, e.v0), vec2(f.u0, f.v0), part);
        point.fourthLevel = levelOf(vec2(d.u1, d.v1), vec2(e.u1, e.v1), vec2(f.u1, f.v1), part);
    }
    return point;
}

// Returns the point for look-ups of alpha and emission by rays without a width: the full-size level.
SHARED_FN TexturePoint finestPoint(SCENE_PARAMETER const Surface surface, const vec3 weights) {
    return texturePoint(SCENE surface, weights, 0.0f, 0.0f);
}

SHARED_FN vec4 vertexColor(SCENE_PARAMETER const Surface surface, const vec3 weights) {
    if (!hasFeature(SCENE kFeatureColors)) {
        return vec4(1.0f);
    }
    return loadColor(SCENE surface.vertex0) * weights.x + loadColor(SCENE surface.vertex1) * weights.y +
           loadColor(SCENE surface.vertex2) * weights.z;
}

// Returns the opacity of the surface, from 0 to 1.
SHARED_FN float coverageOf(const MaterialRecord material, const float alpha) {
    const float masked = alpha >= material.alphaCutoff ? 1.0f : 0.0f;
    const bool isMask = (material.flags & kMaterialMask) != 0u;
    const bool isBlend = (material.flags & kMaterialBlend) != 0u;
    return isMask ? masked : isBlend ? alpha : 1.0f;
}

SHARED_FN float coverage(SCENE_PARAMETER const MaterialRecord material, const Surface surface,
                         const vec3 weights, const TexturePoint at) {
    if (!hasFeature(SCENE kFeatureAlpha) || (material.flags & (kMaterialMask | kMaterialBlend)) == 0u) {
        return 1.0f;
    }
    const float alpha = material.alpha * vertexColor(SCENE surface, weights).w *
                        lookUp(SCENE material.baseColorTexture, at).w;
    return coverageOf(material, alpha);
}

SHARED_FN vec3 baseColorOf(SCENE_PARAMETER const MaterialRecord record, const vec4 color,
                           const TexturePoint at) {
    return record.baseColor * xyz(color) * xyz(lookUp(SCENE record.baseColorTexture, at));
}

SHARED_FN vec2 metallicAndRoughness(SCENE_PARAMETER const MaterialRecord record, const TexturePoint at) {
    const vec4 texel = lookUp(SCENE record.metallicRoughnessTexture, at);
    return vec2(record.metallic * texel.z, record.roughness * texel.y);
}

SHARED_FN float transmissionOf(SCENE_PARAMETER const MaterialRecord record, const TexturePoint at) {
    if (!hasFeature(SCENE kFeatureTransmission)) {
        return 0.0f;
    }
    return record.transmission * lookUp(SCENE record.transmissionTexture, at).x;
}

// Looks up all textures of the material.
SHARED_FN SurfaceMaterial surfaceMaterial(SCENE_PARAMETER const MaterialRecord record, const vec4 color,
                                          const TexturePoint at, const float ior) {
    SurfaceMaterial material;
    material.baseColor = baseColorOf(SCENE record, color, at);
    const vec2 metallicRoughness = metallicAndRoughness(SCENE record, at);
    material.metallic = metallicRoughness.x;
    material.roughness = metallicRoughness.y;
    material.ior = ior;
    material.flags = record.flags & (kSurfaceVolume | kSurfaceSingleScatter);
    material.specularColor = vec3(1.0f);
    material.specular = 1.0f;
    if (hasFeature(SCENE kFeatureSpecular)) {
        material.specularColor = record.specularColor * xyz(lookUp(SCENE record.specularColorTexture, at));
        material.specular = record.specular * lookUp(SCENE record.specularTexture, at).w;
    }
    material.sheenColor = vec3(0.0f);
    material.sheenRoughness = 0.0f;
    if (hasFeature(SCENE kFeatureSheen)) {
        material.sheenColor = record.sheenColor * xyz(lookUp(SCENE record.sheenColorTexture, at));
        material.sheenRoughness = record.sheenRoughness * lookUp(SCENE record.sheenRoughnessTexture, at).w;
    }
    material.diffuseTransmissionColor = vec3(1.0f);
    material.diffuseTransmission = 0.0f;
    if (hasFeature(SCENE kFeatureDiffuseTransmission)) {
        material.diffuseTransmissionColor =
            record.diffuseTransmissionColor * xyz(lookUp(SCENE record.diffuseTransmissionColorTexture, at));
        material.diffuseTransmission =
            record.diffuseTransmission * lookUp(SCENE record.diffuseTransmissionTexture, at).w;
    }
    material.transmission = transmissionOf(SCENE record, at);
    material.anisotropy = 0.0f;
    if (hasFeature(SCENE kFeatureAnisotropy)) {
        material.anisotropy = record.anisotropy * lookUp(SCENE record.anisotropyTexture, at).z;
    }
    material.coat = 0.0f;
    material.coatRoughness = 0.0f;
    if (hasFeature(SCENE kFeatureCoat)) {
        material.coat = record.coat * lookUp(SCENE record.coatTexture, at).x;
        material.coatRoughness = record.coatRoughness * lookUp(SCENE record.coatRoughnessTexture, at).y;
    }
    material.iridescence = 0.0f;
    material.iridescenceIor = 1.3f;
    material.iridescenceThickness = 0.0f;
    if (hasFeature(SCENE kFeatureIridescence)) {
        const float thickness = lookUp(SCENE record.iridescenceThicknessTexture, at).y;
        material.iridescence = record.iridescence * lookUp(SCENE record.iridescenceTexture, at).x;
        material.iridescenceIor = record.iridescenceIor;
        material.iridescenceThickness =
            blend(record.iridescenceThicknessMinimum, record.iridescenceThicknessMaximum, thickness);
    }
    material.padding0 = 0u;
    material.padding1 = 0u;
    return material;
}

// Returns the normal of a normal map in world space, or `normal` if there is no texture.
SHARED_FN vec3 mappedNormal(SCENE_PARAMETER const uint textureId, const float scale, const TexturePoint at,
                            const vec3 normal, const vec4 tangent) {
    const vec3 texel = xyz(lookUp(SCENE textureId, at)) * 2.0f - vec3(1.0f);
    const vec3 bitangent = crossProduct(normal, xyz(tangent)) * tangent.w;
    const vec3 mapped = xyz(tangent) * (texel.x * scale) + bitangent * (texel.y * scale) + normal * texel.z;
    const float size = dotProduct(mapped, mapped);
    return textureId == kNoTextureRecord || !(size > 0.0f) ? normal : unitVector(mapped);
}

// Returns the directions of the surface at the hit. `wo` has unit length and points away from the surface.
SHARED_FN SurfaceFrame surfaceFrame(SCENE_PARAMETER const MaterialRecord record, const Surface surface,
                                    const vec3 weights, const TexturePoint at, const vec3 geometricNormal,
                                    const vec3 wo) {
    if (!hasFeature(SCENE kFeatureNormals | kFeatureNormalMaps | kFeatureAnisotropy)) {
        return makeFlatFrame(geometricNormal, wo);
    }
    const vec3 n0 = loadVertexNormal(SCENE surface.vertex0);
    const vec3 n1 = loadVertexNormal(SCENE surface.vertex1);
    const vec3 n2 = loadVertexNormal(SCENE surface.vertex2);
    const vec3 mixed = n0 * weights.x + n1 * weights.y + n2 * weights.z;
    const float size = dotProduct(mixed, mixed);
    const vec3 smoothNormal = size > 1e-12f ? unitVector(mixed) : geometricNormal;
    vec3 normal = smoothNormal;
    vec3 coatNormal = smoothNormal;
    vec3 along = vec3(0.0f);
    if (hasFeature(SCENE kFeatureNormalMaps | kFeatureAnisotropy)) {
        const vec4 tangent = loadTangent(SCENE surface.vertex0) * weights.x +
                             loadTangent(SCENE surface.vertex1) * weights.y +
                             loadTangent(SCENE surface.vertex2) * weights.z;
        const float length = dotProduct(xyz(tangent), xyz(tangent));
        const Basis any = basisAround(smoothNormal);
        const vec3 unit = length > 1e-12f ? unitVector(xyz(tangent)) : any.tangent;
        const vec4 oriented = vec4(unit.x, unit.y, unit.z, tangent.w < 0.0f ? -1.0f : 1.0f);
        normal = mappedNormal(SCENE record.normalTexture, record.normalScale, at, smoothNormal, oriented);
        if (hasFeature(SCENE kFeatureCoat)) {
            coatNormal = mappedNormal(SCENE record.coatNormalTexture, record.coatNormalScale, at,
                                      smoothNormal, oriented);
        }
        if (hasFeature(SCENE kFeatureAnisotropy)) {
            const vec3 texel = xyz(lookUp(SCENE record.anisotropyTexture, at)) * 2.0f - vec3(1.0f);
            const bool isMapped = record.anisotropyTexture != kNoTextureRecord;
            const float x = isMapped ? texel.x : 1.0f;
            const float y = isMapped ? texel.y : 0.0f;
            const float turnedX = record.anisotropyCosine * x - record.anisotropySine * y;
            const float turnedY = record.anisotropySine * x + record.anisotropyCosine * y;
            along = unit * turnedX + crossProduct(smoothNormal, unit) * (oriented.w * turnedY);
        }
    }
    return makeSurfaceFrame(geometricNormal, normal, coatNormal, along, wo);
}

SHARED_END
#endif
