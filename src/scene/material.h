// Materials, by glTF's names, units and defaults.
#pragma once
#include "metamarch/scene/texture.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <string>

namespace metamarch {

enum class AlphaMode { opaque, mask, blend };

// Every factor is finite (but for attenuationDistance) and in glTF's range, colours are linear. A texture
// multiplies its factor, with the channels in brackets; textures whose use is a colour are the isSrgb ones.
// Occlusion is not here: a path tracer finds its own.
struct Material {
    std::string name;

    // glTF 2.0, 3.9
    glm::vec4 baseColorFactor{1.0f};
    TextureRef baseColorTexture; // rgba
    float metallicFactor = 1.0f;
    float roughnessFactor = 1.0f;
    TextureRef metallicRoughnessTexture; // g: roughness, b: metallic
    TextureRef normalTexture;            // rgb * 2 - 1
    float normalScale = 1.0f;            // of its x and y
    glm::vec3 emissiveFactor{0.0f};
    TextureRef emissiveTexture; // rgb
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f; // of mask: below it there is nothing
    bool doubleSided = false;

    bool unlit = false;            // KHR_materials_unlit: base colour is what is seen
    float emissiveStrength = 1.0f; // KHR_materials_emissive_strength: emitted radiance is factor * strength
    float ior = 1.5f;              // KHR_materials_ior: at least 1, or 0 for a dielectric that reflects all
    float dispersion = 0.0f;       // KHR_materials_dispersion: 20 / Abbe number

    // KHR_materials_transmission
    float transmissionFactor = 0.0f;
    TextureRef transmissionTexture; // r

    // KHR_materials_diffuse_transmission
    float diffuseTransmissionFactor = 0.0f;
    TextureRef diffuseTransmissionTexture; // a
    glm::vec3 diffuseTransmissionColorFactor{1.0f};
    TextureRef diffuseTransmissionColorTexture; // rgb

    // KHR_materials_volume; lengths in world units
    float thicknessFactor = 0.0f; // 0: a thin wall, no volume behind it; else the geometry bounds the volume
    TextureRef thicknessTexture;  // g
    float attenuationDistance = std::numeric_limits<float>::infinity();
    glm::vec3 attenuationColor{1.0f}; // what is left of white light after attenuationDistance

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
    float iridescenceThicknessMaximum = 400.0f; // where it is 1, and without one
    TextureRef iridescenceThicknessTexture;     // g
};

inline constexpr std::size_t kTexturesOfMaterial = 18;

// Every texture use of a material, for whoever treats them alike.
std::array<TextureRef*, kTexturesOfMaterial> texturesOf(Material& material);

// What lies in the tangent plane: a surface with such a material needs tangents.
bool needsTangents(const Material& material);

// The set of texture coordinates that tangents follow: the normal map's, else that of what else needs them.
std::uint32_t texCoordOfTangents(const Material& material);

} // namespace metamarch
