// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mtl_material.h"

#include <assimp/ObjMaterial.h>

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

// MTL's illumination models that transmit light, and those among them that refract it.
constexpr bool isGlass(int illumination) {
    return illumination == 4 || illumination == 6 || illumination == 7 || illumination == 9;
}
constexpr bool isRefracting(int illumination) { return illumination == 6 || illumination == 7; }

// Maps NaN to 0.
float clamped(float value, float most = 1.0f) { return value > 0.0f ? std::min(value, most) : 0.0f; }

std::optional<float> number(const aiMaterial& source, const char* key, unsigned type, unsigned index) {
    float value = 0.0f;
    return source.Get(key, type, index, value) == AI_SUCCESS && std::isfinite(value) ? std::optional(value)
                                                                                     : std::nullopt;
}

glm::vec3 color(const aiMaterial& source, const char* key, unsigned type, unsigned index) {
    aiColor3D value;
    if (source.Get(key, type, index, value) != AI_SUCCESS) {
        return glm::vec3(0.0f);
    }
    constexpr float kMost = std::numeric_limits<float>::max();
    return {clamped(value.r, kMost), clamped(value.g, kMost), clamped(value.b, kMost)};
}

bool has(const aiMaterial& source, aiTextureType type) { return source.GetTextureCount(type) > 0; }

// File names may use another system's separators.
TextureSource sourceOf(const InputFile& file, const aiMaterial& material, aiTextureType type) {
    aiString path;
    material.GetTexture(type, 0, &path);
    std::string name = path.C_Str();
    std::ranges::replace(name, '\\', '/');
    return fileSource(file, name);
}

Texture samplerOf(const aiMaterial& material, aiTextureType type) {
    aiString path;
    aiTextureMapMode modes[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    material.GetTexture(type, 0, &path, nullptr, nullptr, nullptr, nullptr, modes);
    const auto wrap = [](aiTextureMapMode mode) {
        return mode == aiTextureMapMode_Clamp ? TextureWrap::clampToEdge : TextureWrap::repeat;
    };
    Texture sampler;
    sampler.wrapS = wrap(modes[0]);
    sampler.wrapT = wrap(modes[1]);
    return sampler;
}

void readEmission(const aiMaterial& source, Material& material) {
    glm::vec3 emission = color(source, AI_MATKEY_COLOR_EMISSIVE);
    if (has(source, aiTextureType_EMISSIVE) && emission == glm::vec3(0.0f)) {
        emission = glm::vec3(1.0f);
    }
    material.emissiveStrength = std::max({1.0f, emission.r, emission.g, emission.b});
    material.emissiveFactor = emission / material.emissiveStrength;
}

void readReflection(const aiMaterial& source, Material& material) {
    const std::optional<float> roughness = number(source, AI_MATKEY_ROUGHNESS_FACTOR);
    const std::optional<float> metallic = number(source, AI_MATKEY_METALLIC_FACTOR);
    const bool isPhysical = roughness || metallic || has(source, aiTextureType_DIFFUSE_ROUGHNESS) ||
                            has(source, aiTextureType_METALNESS);
    material.metallicFactor = clamped(metallic.value_or(has(source, aiTextureType_METALNESS) ? 1.0f : 0.0f));
    if (isPhysical) {
        material.roughnessFactor = clamped(roughness.value_or(1.0f));
        return;
    }
    const float exponent =
        clamped(number(source, AI_MATKEY_SHININESS).value_or(0.0f), std::numeric_limits<float>::max());
    material.roughnessFactor = std::sqrt(std::sqrt(2.0f / (exponent + 2.0f))); // glTF: alpha is its square
    material.specularColorFactor = glm::min(color(source, AI_MATKEY_COLOR_SPECULAR), glm::vec3(1.0f));
    material.specularFactor = material.specularColorFactor == glm::vec3(0.0f) ? 0.0f : 1.0f;
}

void readOpacity(const aiMaterial& source, Material& material) {
    const float opacity = clamped(number(source, AI_MATKEY_OPACITY).value_or(1.0f));
    int illumination = 0;
    source.Get(AI_MATKEY_OBJ_ILLUM, illumination);
    if (isGlass(illumination)) {
        material.transmissionFactor = 1.0f - opacity;
        material.ior = std::max(number(source, AI_MATKEY_REFRACTI).value_or(1.5f), 1.0f);
        material.thicknessFactor = isRefracting(illumination) ? 1.0f : 0.0f;
        return;
    }
    material.baseColorFactor.a = opacity;
    if (opacity < 1.0f || has(source, aiTextureType_OPACITY)) {
        material.alphaMode = AlphaMode::blend;
    }
}

} // namespace

Material MtlTextures::read(const aiMaterial& source) {
    Material material;
    material.name = source.GetName().C_Str();
    material.baseColorFactor =
        glm::vec4(glm::min(color(source, AI_MATKEY_COLOR_DIFFUSE), glm::vec3(1.0f)), 1.0f);
    material.doubleSided = true; // OBJ has no single-sided surfaces
    readEmission(source, material);
    readReflection(source, material);
    readOpacity(source, material);
    readTextures(source, material);
    return material;
}

void MtlTextures::readTextures(const aiMaterial& source, Material& material) {
    std::vector<TextureOverlay> alpha;
    if (has(source, aiTextureType_OPACITY)) {
        alpha.push_back({sourceOf(file_, source, aiTextureType_OPACITY), 3});
    }
    if (has(source, aiTextureType_DIFFUSE)) {
        material.baseColorTexture = add(source, aiTextureType_DIFFUSE, true, alpha);
    } else if (!alpha.empty()) {
        material.baseColorTexture = addWhite(alpha);
    }

    std::vector<TextureOverlay> metallic;
    if (has(source, aiTextureType_METALNESS)) {
        metallic.push_back({sourceOf(file_, source, aiTextureType_METALNESS), 2});
    }
    if (has(source, aiTextureType_DIFFUSE_ROUGHNESS)) { // the map is grey; glTF reads roughness from g
        material.metallicRoughnessTexture = add(source, aiTextureType_DIFFUSE_ROUGHNESS, false, metallic);
    } else if (!metallic.empty()) {
        material.metallicRoughnessTexture = addWhite(metallic);
    }

    if (has(source, aiTextureType_SPECULAR) && material.specularFactor > 0.0f) {
        material.specularColorTexture = add(source, aiTextureType_SPECULAR, true);
    }
    if (has(source, aiTextureType_EMISSIVE)) {
        material.emissiveTexture = add(source, aiTextureType_EMISSIVE, true);
    }
    if (has(source, aiTextureType_NORMALS)) {
        material.normalTexture = add(source, aiTextureType_NORMALS, false);
    }
    for (const aiTextureType type :
         {aiTextureType_HEIGHT, aiTextureType_DISPLACEMENT, aiTextureType_REFLECTION}) {
        if (has(source, type)) {
            file_.warn("material '" + material.name +
                       "': maps of bumps, displacement and reflection are not rendered");
        }
    }
}

TextureRef MtlTextures::add(const aiMaterial& source, aiTextureType type, bool isSrgb,
                            std::vector<TextureOverlay> overlays) {
    TextureSource image = sourceOf(file_, source, type);
    image.overlays = std::move(overlays);
    return append(samplerOf(source, type), std::move(image), isSrgb);
}

TextureRef MtlTextures::addWhite(std::vector<TextureOverlay> overlays) {
    TextureSource image = overlays.front().source;
    image.read = nullptr;
    image.overlays = std::move(overlays);
    return append(Texture(), std::move(image), false);
}

// Reuses an earlier source that has the same image and the same overlays.
TextureRef MtlTextures::append(const Texture& sampler, TextureSource source, bool isSrgb) {
    const auto sameFiles = [&source](const TextureSource& other) {
        return other.name == source.name && (other.read == nullptr) == (source.read == nullptr) &&
               std::ranges::equal(other.overlays, source.overlays,
                                  [](const TextureOverlay& a, const TextureOverlay& b) {
                                      return a.source.name == b.source.name && a.channel == b.channel;
                                  });
    };
    const auto known = std::ranges::find_if(sources_, sameFiles);
    Texture texture = sampler;
    texture.image = static_cast<std::uint32_t>(known - sources_.begin());
    if (known == sources_.end()) {
        sources_.push_back(std::move(source));
    }
    textures_.push_back(texture);
    TextureRef ref;
    ref.texture = static_cast<std::uint32_t>(textures_.size()) - 1;
    ref.isSrgb = isSrgb;
    return ref;
}

} // namespace metamarch
