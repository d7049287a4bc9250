// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mtl_material.h"

#include "metamarch/scene/mesh/companion_name.h"
#include "metamarch/scene/texture/height_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace metamarch {
namespace {

// MTL's illumination models that transmit light, and those among them that refract it.
constexpr bool isGlass(int illumination) {
    return illumination == 4 || illumination == 6 || illumination == 7 || illumination == 9;
}
constexpr bool isRefracting(int illumination) { return illumination == 6 || illumination == 7; }

constexpr float kMost = std::numeric_limits<float>::max();

float unit(float value) { return std::clamp(value, 0.0f, 1.0f); }

// A map without its number has factor 1. The map's own factor multiplies it.
float factor(const std::optional<float>& number, const MtlMap& map) {
    return unit(number.value_or(map.isGiven() ? 1.0f : 0.0f) * map.valueFactor);
}
glm::vec3 factor(const std::optional<glm::vec3>& color, const MtlMap& map, float without) {
    return glm::max(color.value_or(glm::vec3(map.isGiven() ? 1.0f : without)) * map.valueFactor,
                    glm::vec3(0.0f));
}

void readEmission(const MtlMaterial& source, Material& material) {
    glm::vec3 emission = glm::min(factor(source.emission, source.emissionMap, 0.0f), glm::vec3(kMost));
    if (source.emissionMap.isGiven() && emission == glm::vec3(0.0f)) { // black is what programs write first
        emission = glm::vec3(1.0f);
    }
    material.emissiveStrength = std::max({1.0f, emission.r, emission.g, emission.b});
    material.emissiveFactor = emission / material.emissiveStrength;
}

void readReflection(const MtlMaterial& source, Material& material) {
    const bool isPhysical =
        source.roughness || source.metallic || source.roughnessMap.isGiven() || source.metallicMap.isGiven();
    material.metallicFactor = factor(source.metallic, source.metallicMap);
    if (isPhysical) {
        material.roughnessFactor = unit(source.roughness.value_or(1.0f) * source.roughnessMap.valueFactor);
        return;
    }
    const float exponent = std::max(source.exponent.value_or(0.0f), 0.0f);
    material.roughnessFactor = std::sqrt(std::sqrt(2.0f / (exponent + 2.0f))); // glTF: alpha is its square
    material.specularColorFactor =
        glm::min(factor(source.specular, source.specularMap, 0.0f), glm::vec3(1.0f));
    material.specularFactor = material.specularColorFactor == glm::vec3(0.0f) ? 0.0f : 1.0f;
}

void readLayers(const MtlMaterial& source, Material& material) {
    constexpr float kSheenRoughness = 0.5f;
    material.sheenColorFactor = glm::vec3(factor(source.sheen, source.sheenMap));
    if (material.sheenColorFactor != glm::vec3(0.0f)) {
        material.sheenRoughnessFactor = kSheenRoughness;
    }
    material.clearcoatFactor = factor(source.clearcoat, source.clearcoatMap);
    material.clearcoatRoughnessFactor = factor(source.clearcoatRoughness, source.clearcoatRoughnessMap);
    material.anisotropyStrength = unit(source.anisotropy.value_or(0.0f));
    const float turns = source.anisotropyRotation.value_or(0.0f);
    material.anisotropyRotation = 2.0f * std::numbers::pi_v<float> * (turns - std::floor(turns));
}

std::optional<int> channelOf(char name) {
    constexpr std::string_view kNames = "rgbml";
    static_assert(TextureOverlay::kLuminance == 4);
    const std::size_t index = kNames.find(name);
    return index == std::string_view::npos ? std::nullopt : std::optional(static_cast<int>(index));
}

constexpr int kAlpha = 3;

// Equal for sources that make the same picture. No name of a library has the end of a line in it.
std::string keyOf(const TextureSource& source) {
    std::string key = source.image.name + (source.image.read == nullptr ? "\nwhite" : "\n") +
                      (source.edit == nullptr ? "" : "edited");
    for (const TextureOverlay& overlay : source.overlays) {
        key += '\n' + overlay.image.name + '\n' + std::to_string(overlay.channel) + ' ' +
               std::to_string(overlay.from);
    }
    return key;
}

} // namespace

Material MtlTextures::read(const MtlMaterial& source) {
    constexpr float kDiffuse = 0.6f; // of a material that says nothing of it
    Material material;
    material.name = source.name;
    material.baseColorFactor =
        glm::vec4(glm::min(factor(source.diffuse, source.diffuseMap, kDiffuse), glm::vec3(1.0f)), 1.0f);
    material.doubleSided = true; // OBJ has no single-sided surfaces
    readEmission(source, material);
    readReflection(source, material);
    readLayers(source, material);
    readOpacity(source, material);
    readColorMaps(source, material);
    readPhysicalMaps(source, material);
    readNormalMaps(source, material);
    return material;
}

// Programs do not agree on Tr. Most write 1 - d, MeshLab and those that follow it write d.
void MtlTextures::readOpacity(const MtlMaterial& source, Material& material) {
    const bool transmits = isGlass(source.illumination);
    float opacity = unit(source.opacity.value_or(1.0f));
    if (!source.opacity && source.transparency) {
        const float given = unit(*source.transparency);
        opacity = source.isByMeshLab ? given : 1.0f - given;
        if (opacity == 0.0f && !transmits) {
            opacity = 1.0f;
            madeOpaque_.add(source.name);
        }
    }
    if (transmits) {
        material.transmissionFactor = 1.0f - opacity;
        material.ior = std::max(source.ior.value_or(1.5f), 1.0f);
        material.thicknessFactor = isRefracting(source.illumination) ? 1.0f : 0.0f;
        return;
    }
    if (opacity == 0.0f) {
        invisible_.add(source.name);
    }
    material.baseColorFactor.a = unit(opacity * source.opacityMap.valueFactor);
    if (opacity < 1.0f || source.opacityMap.isGiven()) {
        material.alphaMode = AlphaMode::blend;
    }
}

void MtlTextures::readColorMaps(const MtlMaterial& source, Material& material) {
    if (source.diffuseMap.isGiven()) {
        TextureSource image{imageOf(source.diffuseMap)};
        if (source.opacityMap.isGiven()) {
            image.overlays.push_back(overlayOf(source.opacityMap, kAlpha));
            noteUnlessSameUse(source.opacityMap, source.diffuseMap);
        }
        material.baseColorTexture = add(source.diffuseMap, std::move(image), true);
    } else if (source.opacityMap.isGiven()) {
        material.baseColorTexture = add(source.opacityMap, greySource(source.opacityMap, {kAlpha}), false);
    }
    if (source.specularMap.isGiven() && material.specularFactor > 0.0f) {
        material.specularColorTexture = add(source.specularMap, {imageOf(source.specularMap)}, true);
    }
    if (source.emissionMap.isGiven()) {
        material.emissiveTexture = add(source.emissionMap, {imageOf(source.emissionMap)}, true);
    }
}

// The channels are those that glTF reads.
void MtlTextures::readPhysicalMaps(const MtlMaterial& source, Material& material) {
    if (source.roughnessMap.isGiven()) {
        TextureSource image = greySource(source.roughnessMap, {1});
        if (source.metallicMap.isGiven()) {
            image.overlays.push_back(overlayOf(source.metallicMap, 2));
            noteUnlessSameUse(source.metallicMap, source.roughnessMap);
        }
        material.metallicRoughnessTexture = add(source.roughnessMap, std::move(image), false);
    } else if (source.metallicMap.isGiven()) {
        material.metallicRoughnessTexture =
            add(source.metallicMap, greySource(source.metallicMap, {2}), false);
    }
    if (source.sheenMap.isGiven()) {
        material.sheenColorTexture = add(source.sheenMap, greySource(source.sheenMap, {0, 1, 2}), false);
    }
    if (source.clearcoatMap.isGiven()) {
        material.clearcoatTexture = add(source.clearcoatMap, greySource(source.clearcoatMap, {0}), false);
    }
    if (source.clearcoatRoughnessMap.isGiven()) {
        material.clearcoatRoughnessTexture =
            add(source.clearcoatRoughnessMap, greySource(source.clearcoatRoughnessMap, {1}), false);
    }
}

void MtlTextures::readNormalMaps(const MtlMaterial& source, Material& material) {
    if (source.normalMap.isGiven()) {
        material.normalTexture = add(source.normalMap, {imageOf(source.normalMap)}, false);
        material.normalScale = source.normalMap.bumpMultiplier;
        if (source.bumpMap.isGiven()) {
            withoutBumpMap_.add(source.name);
        }
    } else if (source.bumpMap.isGiven()) {
        TextureSource image = source.bumpMap.channel == '\0' ? TextureSource{imageOf(source.bumpMap)}
                                                             : greySource(source.bumpMap, {0, 1, 2});
        image.edit = heightsToNormals;
        material.normalTexture = add(source.bumpMap, std::move(image), false);
        material.normalScale = source.bumpMap.bumpMultiplier * source.bumpMap.valueFactor;
    }
}

// Two maps that become one picture are looked up at the same place.
void MtlTextures::noteUnlessSameUse(const MtlMap& map, const MtlMap& shared) {
    if (map.scale != shared.scale || map.offset != shared.offset || map.clamp != shared.clamp) {
        mapsWithoutOptions_.add(map.name);
    }
}

void MtlTextures::warn() {
    const auto warn = [this](const NameList& names, const std::string& before, const std::string& after) {
        if (!names.empty()) {
            file_.warn(before + names.text() + after);
        }
    };
    warn(madeOpaque_, "by Tr nothing would be seen of the materials ", "; they are rendered opaque");
    warn(invisible_, "nothing is seen of the materials ", ": their d is 0");
    warn(withoutBumpMap_, "the bump maps of the materials ", " are not rendered: they have normal maps");
    warn(mapsWithoutOptions_, "the options of the maps ",
         " are not rendered: each becomes one picture with another map, whose options hold for both");
}

// Many materials use the same map, and each look-up of a name asks the file system several times.
const EncodedImage& MtlTextures::imageOf(const MtlMap& map) {
    const auto [found, isNew] = imageOfName_.try_emplace(map.folder + '\n' + map.name);
    if (isNew) {
        found->second = imageFile(file_, companionName(file_, map.folder, map.name));
    }
    return found->second;
}

// A mask is the alpha of its picture where it has one.
TextureOverlay MtlTextures::overlayOf(const MtlMap& map, int channel) {
    const int byItself = channel == kAlpha ? TextureOverlay::kAlphaOrRed : 0;
    return {imageOf(map), channel, channelOf(map.channel).value_or(byItself)};
}

// A white picture whose `channels` are the map.
TextureSource MtlTextures::greySource(const MtlMap& map, std::initializer_list<int> channels) {
    TextureSource source{imageOf(map)};
    source.image.read = nullptr;
    for (const int channel : channels) {
        source.overlays.push_back(overlayOf(map, channel));
    }
    return source;
}

// Reuses an earlier source that makes the same picture.
TextureRef MtlTextures::add(const MtlMap& map, TextureSource source, bool isSrgb) {
    Texture texture;
    texture.wrapS = texture.wrapT = map.clamp ? TextureWrap::clampToEdge : TextureWrap::repeat;
    const auto next = static_cast<std::uint32_t>(sources_.size());
    const auto [found, isNew] = pictures_.try_emplace(keyOf(source), next);
    if (isNew) {
        sources_.push_back(std::move(source));
    }
    texture.image = found->second;
    textures_.push_back(texture);
    TextureRef ref;
    ref.texture = static_cast<std::uint32_t>(textures_.size()) - 1;
    ref.isSrgb = isSrgb;
    // MTL counts v from below: 1 - (scale * (1 - v) + offset).
    ref.transform =
        glm::mat3x2(map.scale.x, 0.0f, 0.0f, map.scale.y, map.offset.x, 1.0f - map.scale.y - map.offset.y);
    return ref;
}

} // namespace metamarch
