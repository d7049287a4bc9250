// SPDX-License-Identifier: MIT
// Materials, with glTF's names, units and defaults.
#pragma once
#include "metamarch/scene/texture.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <string>

namespace metamarch {

enum class AlphaMode { opaque, mask, blend };

// All factors except attenuationDistance are finite and in glTF's range; colours are linear. A texture
// multiplies its factor; the comment names the channels that count. Colour textures have isSrgb set. There is
// no occlusion texture: a path tracer computes occlusion itself.
struct Material {
    std::string name;

    // glTF 2.0, 3.9
    glm::vec4 baseColorFactor{1.0f};
    TextureRef baseColorTexture; // rgba
    float metallicFactor = 1.0f;
    float roughnessFactor = 1.0f;
    TextureRef metallicRoughnessTexture; // g: roughness, b: metallic
    TextureRef normalTexture;            // rgb * 2 - 1
    float normalScale = 1.0f;            // scales the x and y of the normal map
    glm::vec3 emissiveFactor{0.0f};
    TextureRef emissiveTexture; // rgb
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f; // for AlphaMode::mask: below it the surface is absent
    bool doubleSided = false;

    bool unlit = false;            // KHR_materials_unlit: shows the base colour without shading
    float emissiveStrength = 1.0f; // KHR_materials_emissive_strength: emitted radiance is factor * strength
    float ior = 1.5f;        // KHR_materials_ior: at least 1, or 0 for a dielectric with a reflectance of 1
    float dispersion = 0.0f; // KHR_materials_dispersion: 20 / Abbe number

    // KHR_materials_transmission
    float transmissionFactor = 0.0f;
    TextureRef transmissionTexture; // r

    // KHR_materials_diffuse_transmission
    float diffuseTransmissionFactor = 0.0f;
    TextureRef diffuseTransmissionTexture; // a
    glm::vec3 diffuseTransmissionColorFactor{1.0f};
    TextureRef diffuseTransmissionColorTexture; // rgb

    // KHR_materials_volume; lengths in world units. Thickness 0 means a thin wall without a volume behind it,
    // otherwise the mesh encloses a volume.
    float thicknessFactor = 0.0f;
    TextureRef thicknessTexture; // g
    float attenuationDistance = std::numeric_limits<float>::infinity();
    glm::vec3 attenuationColor{1.0f}; // colour of white light after it travels attenuationDistance

    // KHR_materials_specular
    float specularFactor = 1.0f;
    TextureRef specularTexture; // a
    glm::vec3 specularColorFactor{1.0f};
    TextureRef specularColorTexture; // rgb

    // KHR_materials_clearcoat
    float clearcoatFactor = 0.0f;
    TextureRef clearcoatTexture; // r
    float clearcoatRoughnessFactor = 0.0f;
    TextureRef clearcoatRoughnessTexture; // g
    TextureRef clearcoatNormalTexture;    // rgb * 2 - 1
    float clearcoatNormalScale = 1.0f;

    // KHR_materials_sheen
    glm::vec3 sheenColorFactor{0.0f};
    TextureRef sheenColorTexture; // rgb
    float sheenRoughnessFactor = 0.0f;
    TextureRef sheenRoughnessTexture; // a

    // KHR_materials_anisotropy
    float anisotropyStrength = 0.0f;
    float anisotropyRotation = 0.0f; // radians, from the tangent towards the bitangent
    TextureRef anisotropyTexture;    // rg * 2 - 1: direction, b: strength

    // KHR_materials_iridescence; thickness in nanometres
    float iridescenceFactor = 0.0f;
    TextureRef iridescenceTexture; // r
    float iridescenceIor = 1.3f;
    float iridescenceThicknessMinimum = 100.0f; // where the texture is 0
    float iridescenceThicknessMaximum = 400.0f; // where the texture is 1, or without a texture
    TextureRef iridescenceThicknessTexture;     // g
};

inline constexpr std::size_t kTexturesOfMaterial = 18;

// Returns every texture reference of a material, for code that treats them alike.
std::array<TextureRef*, kTexturesOfMaterial> texturesOf(Material& material);

// Whether the material depends on a direction in the tangent plane, so that a surface with it needs tangents.
bool needsTangents(const Material& material);

// Returns the set of texture coordinates that the tangents follow: the normal map's, or, without one, that of
// another texture that needs tangents.
std::uint32_t texCoordOfTangents(const Material& material);

} // namespace metamarch
