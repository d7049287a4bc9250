// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace metamarch {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<float>::max();

float factor(const GltfElement& source, const char* key, double fallback, double least = 0.0,
             double most = 1.0) {
    return static_cast<float>(std::clamp(source.number(key, fallback), least, most));
}

glm::vec3 color(const GltfElement& source, const char* key, double fallback) {
    return glm::vec3(glm::clamp(source.vector<3>(key, glm::dvec3(fallback)), 0.0, 1.0));
}

class MaterialReader {
  public:
    MaterialReader(const GltfElement& source, GltfTextures& textures, double scale)
        : source_(source), textures_(textures), unit_(std::abs(scale)) {}

    Material read() {
        material_.name = source_.text("name");
        if (const auto glossy = source_.extension("KHR_materials_pbrSpecularGlossiness")) {
            readSpecularGlossiness(*glossy);
        } else {
            readMetallicRoughness();
        }
        readSurface();
        readTransmission();
        readCoats();
        return std::move(material_);
    }

  private:
    void readMetallicRoughness() {
        const GltfElement pbr = source_.object("pbrMetallicRoughness");
        Material& m = material_;
        m.baseColorFactor =
            glm::vec4(glm::clamp(pbr.vector<4>("baseColorFactor", glm::dvec4(1.0)), 0.0, 1.0));
        m.baseColorTexture = textures_.ref(pbr, "baseColorTexture", true);
        m.metallicFactor = factor(pbr, "metallicFactor", 1.0);
        m.roughnessFactor = factor(pbr, "roughnessFactor", 1.0);
        m.metallicRoughnessTexture = textures_.ref(pbr, "metallicRoughnessTexture", false);
        if (const auto refraction = source_.extension("KHR_materials_ior")) {
            m.ior = factor(*refraction, "ior", 1.5, 0.0, kLargest);
            m.ior = m.ior == 0.0f ? 0.0f : std::max(m.ior, 1.0f);
        }
        if (const auto specular = source_.extension("KHR_materials_specular")) {
            m.specularFactor = factor(*specular, "specularFactor", 1.0);
            m.specularTexture = textures_.ref(*specular, "specularTexture", false);
            // The only colour that may exceed 1: it scales the reflectance given by the index of refraction.
            m.specularColorFactor = glm::vec3(
                glm::clamp(specular->vector<3>("specularColorFactor", glm::dvec3(1.0)), 0.0, kLargest));
            m.specularColorTexture = textures_.ref(*specular, "specularColorTexture", true);
        }
    }

    // Reads the extension in place of the core's reflection, as it asks. The core's part is for readers
    // without the extension, so nothing in it is checked. A dielectric whose index of refraction is given
    // as 0 reflects its specular colour at normal incidence (KHR_materials_ior), which is what the
    // extension's specular colour means.
    void readSpecularGlossiness(const GltfElement& glossy) {
        Material& m = material_;
        m.baseColorFactor =
            glm::vec4(glm::clamp(glossy.vector<4>("diffuseFactor", glm::dvec4(1.0)), 0.0, 1.0));
        m.baseColorTexture = textures_.ref(glossy, "diffuseTexture", true);
        m.metallicFactor = 0.0f;
        m.ior = 0.0f;
        m.specularColorFactor = color(glossy, "specularFactor", 1.0);
        m.specularColorTexture = textures_.ref(glossy, "specularGlossinessTexture", true);
        const float glossiness = factor(glossy, "glossinessFactor", 1.0);
        m.metallicRoughnessTexture = textures_.roughnessRef(glossy, "specularGlossinessTexture", glossiness);
        m.roughnessFactor = m.metallicRoughnessTexture.texture == kNoTexture ? 1.0f - glossiness : 1.0f;
    }

    // Reads what all materials have.
    void readSurface() {
        Material& m = material_;
        m.normalTexture = textures_.ref(source_, "normalTexture", false);
        m.normalScale = normalScale(source_, "normalTexture");
        m.emissiveFactor = color(source_, "emissiveFactor", 0.0);
        m.emissiveTexture = textures_.ref(source_, "emissiveTexture", true);
        m.alphaMode = alphaMode();
        m.alphaCutoff = factor(source_, "alphaCutoff", 0.5, 0.0, kLargest);
        m.doubleSided = source_.flag("doubleSided", false);
        m.unlit = source_.extension("KHR_materials_unlit").has_value();
        if (const auto emissive = source_.extension("KHR_materials_emissive_strength")) {
            m.emissiveStrength = factor(*emissive, "emissiveStrength", 1.0, 0.0, kLargest);
        }
        if (const auto dispersion = source_.extension("KHR_materials_dispersion")) {
            m.dispersion = factor(*dispersion, "dispersion", 0.0, 0.0, kLargest);
        }
        if (const auto anisotropy = source_.extension("KHR_materials_anisotropy")) {
            m.anisotropyStrength = factor(*anisotropy, "anisotropyStrength", 0.0);
            m.anisotropyRotation = factor(*anisotropy, "anisotropyRotation", 0.0, -kLargest, kLargest);
            m.anisotropyTexture = textures_.ref(*anisotropy, "anisotropyTexture", false);
        }
    }

    void readTransmission() {
        Material& m = material_;
        if (const auto transmission = source_.extension("KHR_materials_transmission")) {
            m.transmissionFactor = factor(*transmission, "transmissionFactor", 0.0);
            m.transmissionTexture = textures_.ref(*transmission, "transmissionTexture", false);
        }
        if (const auto diffuse = source_.extension("KHR_materials_diffuse_transmission")) {
            m.diffuseTransmissionFactor = factor(*diffuse, "diffuseTransmissionFactor", 0.0);
            m.diffuseTransmissionTexture = textures_.ref(*diffuse, "diffuseTransmissionTexture", false);
            m.diffuseTransmissionColorFactor = color(*diffuse, "diffuseTransmissionColorFactor", 1.0);
            m.diffuseTransmissionColorTexture =
                textures_.ref(*diffuse, "diffuseTransmissionColorTexture", true);
        }
        if (const auto volume = source_.extension("KHR_materials_volume")) {
            m.thicknessFactor = length(*volume, "thicknessFactor", 0.0);
            m.thicknessTexture = textures_.ref(*volume, "thicknessTexture", false);
            m.attenuationDistance = length(*volume, "attenuationDistance", kInfinity);
            if (m.attenuationDistance == 0.0f) {
                volume->refuse("attenuationDistance is 0");
            }
            m.attenuationColor = color(*volume, "attenuationColor", 1.0);
        }
    }

    void readCoats() {
        Material& m = material_;
        if (const auto clearcoat = source_.extension("KHR_materials_clearcoat")) {
            m.clearcoatFactor = factor(*clearcoat, "clearcoatFactor", 0.0);
            m.clearcoatTexture = textures_.ref(*clearcoat, "clearcoatTexture", false);
            m.clearcoatRoughnessFactor = factor(*clearcoat, "clearcoatRoughnessFactor", 0.0);
            m.clearcoatRoughnessTexture = textures_.ref(*clearcoat, "clearcoatRoughnessTexture", false);
            m.clearcoatNormalTexture = textures_.ref(*clearcoat, "clearcoatNormalTexture", false);
            m.clearcoatNormalScale = normalScale(*clearcoat, "clearcoatNormalTexture");
        }
        if (const auto sheen = source_.extension("KHR_materials_sheen")) {
            m.sheenColorFactor = color(*sheen, "sheenColorFactor", 0.0);
            m.sheenColorTexture = textures_.ref(*sheen, "sheenColorTexture", true);
            m.sheenRoughnessFactor = factor(*sheen, "sheenRoughnessFactor", 0.0);
            m.sheenRoughnessTexture = textures_.ref(*sheen, "sheenRoughnessTexture", false);
        }
        if (const auto film = source_.extension("KHR_materials_iridescence")) {
            m.iridescenceFactor = factor(*film, "iridescenceFactor", 0.0);
            m.iridescenceTexture = textures_.ref(*film, "iridescenceTexture", false);
            m.iridescenceIor = factor(*film, "iridescenceIor", 1.3, 1.0, kLargest);
            m.iridescenceThicknessMinimum =
                factor(*film, "iridescenceThicknessMinimum", 100.0, 0.0, kLargest);
            m.iridescenceThicknessMaximum =
                factor(*film, "iridescenceThicknessMaximum", 400.0, 0.0, kLargest);
            m.iridescenceThicknessTexture = textures_.ref(*film, "iridescenceThicknessTexture", false);
        }
    }

    AlphaMode alphaMode() const {
        const std::string mode = source_.text("alphaMode", "OPAQUE");
        if (mode == "OPAQUE") {
            return AlphaMode::opaque;
        }
        if (mode == "MASK") {
            return AlphaMode::mask;
        }
        if (mode == "BLEND") {
            return AlphaMode::blend;
        }
        source_.refuse("alphaMode '" + mode + "' is none of OPAQUE, MASK, BLEND");
    }

    static float normalScale(const GltfElement& source, const char* texture) {
        return factor(source.object(texture), "scale", 1.0, -kLargest, kLargest);
    }

    // The result may be infinite, like the default of attenuationDistance.
    float length(const GltfElement& source, const char* key, double fallback) const {
        return static_cast<float>(std::max(source.number(key, fallback), 0.0) * unit_);
    }

    const GltfElement& source_;
    GltfTextures& textures_;
    double unit_; // world units per unit of length of the file
    Material material_;
};

// Renumbers the file's sets of texture coordinates from 0. Sets 0 and 1 keep their numbers if they are all.
void renumberTexCoords(const GltfElement& source, GltfMaterial& read) {
    std::vector<std::uint32_t> sets;
    for (const TextureRef* ref : texturesOf(read.material)) {
        if (ref->texture != kNoTexture && std::ranges::find(sets, ref->texCoord) == sets.end()) {
            sets.push_back(ref->texCoord);
        }
    }
    std::ranges::sort(sets);
    if (sets.size() > read.texCoordSets.size()) {
        source.refuse(fmt::format("uses {} sets of texture coordinates, the limit is {}", sets.size(),
                                  read.texCoordSets.size()));
    }
    if (sets.empty() || sets.back() <= 1) {
        return;
    }
    read.texCoordSets.fill(kNoTexCoordSet);
    std::ranges::copy(sets, read.texCoordSets.begin());
    for (TextureRef* ref : texturesOf(read.material)) {
        if (ref->texture != kNoTexture) {
            ref->texCoord = static_cast<std::uint32_t>(std::ranges::find(sets, ref->texCoord) - sets.begin());
        }
    }
}

} // namespace

GltfMaterial readMaterial(const GltfElement& source, GltfTextures& textures, double scale) {
    GltfMaterial read{MaterialReader(source, textures, scale).read()};
    renumberTexCoords(source, read);
    return read;
}

} // namespace metamarch
