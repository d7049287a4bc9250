// SPDX-License-Identifier: MIT
#include "metamarch/shading/shading_builder.h"

#include "metamarch/shading/light/light_store.h"
#include "metamarch/shading/shading.h"
#include "metamarch/shading/texture/texel_store.h"
#include "metamarch/shared/microfacet.h"
#include "metamarch/shared/surface.h"

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

// Returns the absorption per world unit. By Beer and Lambert's law, white light that has gone
// material.attenuationDistance through the volume has the colour material.attenuationColor. The absorption of
// black would be infinite, so channels are at least 2^-20.
glm::vec3 absorptionOf(const Material& material) {
    constexpr float kLeastColor = 0x1p-20f;
    if (material.thicknessFactor == 0.0f || !(material.attenuationDistance < 1e30f)) {
        return glm::vec3(0.0f);
    }
    const glm::dvec3 left(glm::max(material.attenuationColor, glm::vec3(kLeastColor)));
    return glm::vec3(-glm::log(left) / static_cast<double>(material.attenuationDistance));
}

std::uint32_t flagsOf(const Material& material, const ShadingOptions& options) {
    return (material.thicknessFactor > 0.0f ? kSurfaceVolume : 0u) |
           (options.isSingleScatter ? kSurfaceSingleScatter : 0u) |
           (material.doubleSided ? kMaterialDoubleSided : 0u) | (material.unlit ? kMaterialUnlit : 0u) |
           (material.alphaMode == AlphaMode::mask ? kMaterialMask : 0u) |
           (material.alphaMode == AlphaMode::blend ? kMaterialBlend : 0u);
}

std::uint32_t featuresOf(const Material& m) {
    const auto feature = [](const bool isUsed, const std::uint32_t bit) { return isUsed ? bit : 0u; };
    const bool hasNormalMap =
        m.normalTexture.texture != kNoTexture || m.clearcoatNormalTexture.texture != kNoTexture;
    const bool isPlainSpecular = m.specularFactor == 1.0f && m.specularColorFactor == glm::vec3(1.0f) &&
                                 m.specularTexture.texture == kNoTexture &&
                                 m.specularColorTexture.texture == kNoTexture;
    const bool mayBeSmooth = m.roughnessFactor * m.roughnessFactor <= kMinAlpha ||
                             m.metallicRoughnessTexture.texture != kNoTexture;
    const bool hasFacets = m.metallicFactor > 0.0f || m.specularFactor > 0.0f ||
                           m.transmissionFactor > 0.0f || m.sheenColorFactor != glm::vec3(0.0f) ||
                           m.iridescenceFactor > 0.0f;
    return feature(hasFacets, kFeatureFacets) | feature(m.clearcoatFactor > 0.0f, kFeatureCoat) |
           feature(m.sheenColorFactor != glm::vec3(0.0f), kFeatureSheen) |
           feature(m.transmissionFactor > 0.0f, kFeatureTransmission) |
           feature(m.transmissionFactor > 0.0f && m.thicknessFactor > 0.0f, kFeatureVolume) |
           feature(m.transmissionFactor > 0.0f && m.thicknessFactor == 0.0f && mayBeSmooth,
                   kFeatureThinGlass) |
           feature(m.diffuseTransmissionFactor > 0.0f, kFeatureDiffuseTransmission) |
           feature(m.diffuseTransmissionFactor > 0.0f && m.thicknessFactor > 0.0f,
                   kFeatureTransmission | kFeatureVolume) |
           feature(m.iridescenceFactor > 0.0f, kFeatureIridescence) |
           feature(hasNormalMap, kFeatureNormalMaps) |
           feature(m.anisotropyStrength > 0.0f, kFeatureAnisotropy) |
           feature(m.alphaMode != AlphaMode::opaque, kFeatureAlpha) |
           feature(m.dispersion > 0.0f && m.thicknessFactor > 0.0f && m.transmissionFactor > 0.0f,
                   kFeatureDispersion) |
           feature(!isPlainSpecular, kFeatureSpecular) | feature(m.unlit, kFeatureUnlit);
}

MaterialRecord recordOf(const Material& m, const ShadingOptions& options, TexelStore& texels) {
    const auto addTexture = [&](const TextureRef& ref) {
        const bool hasHoles = &ref == &m.baseColorTexture && m.alphaMode != AlphaMode::opaque;
        return texels.add(ref, hasHoles ? ColorWeight::byAlpha : ColorWeight::equal);
    };
    MaterialRecord record{};
#define PARAMETER(type, name, value) record.name = value;
#define TEXTURE(name, value) record.name = addTexture(value);
#include "metamarch/shared/material_rows.inc"
    return record;
}

// Returns the white, diffuse material of the integrator `ao` and of shadow catchers. It has no textures, so
// holes that a texture cuts are closed; the alpha of the material itself stays.
Material whitened(const Material& material) {
    Material white;
    white.metallicFactor = 0.0f;
    white.specularFactor = 0.0f;
    white.doubleSided = material.doubleSided;
    white.alphaMode = material.alphaMode;
    white.alphaCutoff = material.alphaCutoff;
    white.baseColorFactor.a = material.baseColorFactor.a;
    return white;
}

// Returns the material by which a polished catcher mirrors objects: it reflects as a dielectric does, and
// nothing else. It is black so that the colours of vertices do not matter.
Material mirrorOf(const float roughness) {
    Material black;
    black.baseColorFactor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    black.metallicFactor = 0.0f;
    black.roughnessFactor = roughness;
    return black;
}

void addSurfaces(const Scene& scene, ShadingScene& target) {
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const glm::uvec3 corners = scene.triangles[i];
        target.surfaces.push_back({corners.x, corners.y, corners.z, materialOf(scene, i)});
    }
    const auto count = static_cast<std::uint32_t>(scene.positions.size());
    const bool hasNormals =
        std::ranges::any_of(scene.normals, [](const glm::vec3& normal) { return normal != glm::vec3(0.0f); });
    target.features |= hasNormals ? kFeatureNormals : 0u;
    const bool hasFurther = (target.features & kFeatureFurtherSets) != 0u;
    const auto addPair = [&](const std::vector<glm::vec2>& first, const std::vector<glm::vec2>& second,
                             const bool isFurther) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec2 a = first.empty() ? glm::vec2(0.0f) : first[i];
            const glm::vec2 b = second.empty() ? glm::vec2(0.0f) : second[i];
            target.vertices.push_back({isFurther ? glm::vec3(0.0f) : scene.normals[i], a.x, a.y, b.x, b.y,
                                       hasFurther && !isFurther ? count + i : 0u});
        }
    };
    addPair(scene.texCoords, scene.texCoords1, false);
    if (hasFurther) {
        addPair(scene.texCoords2, scene.texCoords3, true);
    }
    if (!scene.colors.empty()) {
        target.colors = scene.colors;
        target.features |= kFeatureColors;
    }
    if ((target.features & (kFeatureNormalMaps | kFeatureAnisotropy)) != 0u) {
        target.tangents = scene.tangents;
        target.tangents.resize(scene.positions.size(), glm::vec4(0.0f));
    }
}

} // namespace

ShadingScene makeShadingScene(const Scene& scene, const Surroundings& surroundings,
                              const ShadingOptions& options, const std::uint64_t chunkBytes) {
    ShadingScene target;
    TexelStore texels(scene, chunkBytes, target);
    std::vector<glm::vec3> meanEmission;
    std::vector<Material> materials = materialsWithGrey(scene);
    if (options.isWhite) {
        std::ranges::transform(materials, materials.begin(), whitened);
    }
    target.settings.catcher = options.catcher;
    if (options.catcher != kNoMaterial) {
        target.settings.catcherWhite = static_cast<std::uint32_t>(materials.size());
        target.features |= kFeatureCatcher;
        materials.push_back(whitened({}));
        target.settings.catcherMirror = kNoCatcher;
    }
    if (options.catcher != kNoMaterial && options.catcherReflection) {
        target.settings.catcherMirror = static_cast<std::uint32_t>(materials.size());
        materials.push_back(mirrorOf(*options.catcherReflection));
    }
    for (const Material& material : materials) {
        target.features |= featuresOf(material);
        target.materials.push_back(recordOf(material, options, texels));
        const glm::vec3 emission = target.materials.back().emission;
        // Light sampling leaves out coated materials: a coat dims their emission depending on the angle.
        const bool isKnown = material.clearcoatFactor == 0.0f && !material.unlit;
        const glm::vec3 mean = emission * glm::vec3(texels.meanOf(material.emissiveTexture));
        meanEmission.push_back(isKnown ? mean : glm::vec3(0.0f));
        target.features |= emission != glm::vec3(0.0f) ? kFeatureEmission : 0u;
    }
    texels.addLevels();
    addSurfaces(scene, target);
    addLights(options.isWhite ? std::span<const PunctualLight>() : scene.lights, scene, surroundings,
              meanEmission, target);
    return target;
}

} // namespace metamarch
