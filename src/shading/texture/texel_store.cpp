// SPDX-License-Identifier: MIT
#include "metamarch/shading/texture/texel_store.h"

#include "metamarch/error/error.h"
#include "metamarch/shading/texture/texel_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

std::uint32_t wrapBits(const TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::mirroredRepeat:
        return kWrapMirror;
    case TextureWrap::clampToEdge:
        return kWrapClamp;
    default:
        return kWrapRepeat;
    }
}

bool hasLevels(const TextureFilter filter) { return filter > TextureFilter::linear; }

bool isNearest(const TextureFilter filter) {
    return filter == TextureFilter::nearest || filter == TextureFilter::nearestMipmapNearest ||
           filter == TextureFilter::nearestMipmapLinear;
}

bool isBetweenLevels(const TextureFilter filter) {
    return filter == TextureFilter::nearestMipmapLinear || filter == TextureFilter::linearMipmapLinear;
}

TextureLevel makeLevel(const std::uint32_t width, const std::uint32_t height, const TexelPlace place,
                       const bool isSrgb, const bool isDeep) {
    return {place.firstWord, width, height,
            (isSrgb ? kTexelsSrgb : 0u) | (isDeep ? kTexelsDeep : 0u) | place.chunk << kTexelsChunkShift};
}

// A transform may collapse the texture to a line, which has no area; its level is then the finest.
float unitLevelOf(const TextureImage& image, const glm::mat3x2& transform) {
    constexpr double kLeastTexels = 1e-30;
    const double area = std::abs(static_cast<double>(transform[0][0]) * transform[1][1] -
                                 static_cast<double>(transform[0][1]) * transform[1][0]);
    const double texels = area * image.width * image.height;
    return static_cast<float>(0.5 * std::log2(std::max(texels, kLeastTexels)));
}

} // namespace

TexelStore::TexelStore(const Scene& usedScene, const std::uint64_t chunkBytes, ShadingScene& usedTarget)
    : scene(usedScene), chunkWords(chunkBytes / sizeof(std::uint32_t)), target(usedTarget) {
    for (const TextureImage& image : scene.images) {
        // The smaller levels have a third of the image's texels.
        wordsToCome += std::uint64_t{image.width} * image.height * (isDeep(image) ? 2 : 1) * 4 / 3 + 1;
    }
}

std::optional<TexelPlace> TexelStore::place(const std::vector<std::uint32_t>& words) {
    const auto chunk = std::ranges::find_if(
        target.texels, [&](const auto& used) { return used.size() + words.size() <= chunkWords; });
    if (chunk == target.texels.end()) {
        return std::nullopt;
    }
    const TexelPlace found{static_cast<std::uint32_t>(chunk - target.texels.begin()),
                           static_cast<std::uint32_t>(chunk->size())};
    if (chunk->empty()) { // a chunk that grows would be copied
        chunk->reserve(std::min(chunkWords, wordsToCome));
    }
    chunk->insert(chunk->end(), words.begin(), words.end());
    wordsToCome -= std::min<std::uint64_t>(wordsToCome, words.size());
    return found;
}

TexelPlace TexelStore::placeOf(const std::uint32_t image) {
    const auto known = places.find(image);
    if (known != places.end()) {
        return known->second;
    }
    const std::optional<TexelPlace> found = place(wordsOf(scene.images[image]));
    if (!found) {
        throw Error(
            ErrorKind::outOfMemory,
            fmt::format("the scene's textures do not fit {} buffers of {} MiB: {} with {} x {} texels "
                        "is one too many",
                        kTexelChunks, chunkWords * sizeof(std::uint32_t) >> 20u, scene.images[image].name,
                        scene.images[image].width, scene.images[image].height));
    }
    places.emplace(image, *found);
    return *found;
}

std::uint32_t TexelStore::add(const TextureRef& ref, const ColorWeight weight) {
    if (ref.texture == kNoTexture) {
        return kNoTextureRecord;
    }
    const Texture& texture = scene.textures[ref.texture];
    const TextureImage& image = scene.images[texture.image];
    const auto id = static_cast<std::uint32_t>(target.textures.size());
    TextureRecord record{};
    record.level = makeLevel(image.width, image.height, placeOf(texture.image), ref.isSrgb, isDeep(image));
    record.use.rowU = {ref.transform[0][0], ref.transform[1][0], ref.transform[2][0]};
    record.use.rowV = {ref.transform[0][1], ref.transform[1][1], ref.transform[2][1]};
    record.use.unitLevel = unitLevelOf(image, ref.transform);
    const bool isMagnifiedNearest = isNearest(texture.magFilter);
    const bool isMinifiedNearest = isNearest(texture.minFilter);
    record.use.flags =
        wrapBits(texture.wrapS) | wrapBits(texture.wrapT) << kTextureWrapTShift |
        (isMagnifiedNearest ? kTextureNearest : 0u) | (isMinifiedNearest ? kTextureMinifiedNearest : 0u) |
        (isBetweenLevels(texture.minFilter) ? kTextureBetweenLevels : 0u) |
        (ref.texCoord % 2 == 1 ? kTextureSecondSet : 0u) | (ref.texCoord >= 2 ? kTextureFurtherSet : 0u);
    target.features |= kFeatureTextures | (ref.texCoord >= 2 ? kFeatureFurtherSets : 0u) |
                       (isDeep(image) ? kFeatureDeepTextures : 0u) |
                       (isMagnifiedNearest != isMinifiedNearest ? kFeatureMipmaps : 0u);
    target.textures.push_back(record);
    if (hasLevels(texture.minFilter)) {
        wanted.push_back({id, {texture.image, ref.isSrgb, weight}});
        target.textures.resize(id + mipLevelCount(image.width, image.height));
    }
    return id;
}

void TexelStore::addLevels() {
    for (const auto& [record, pyramid] : wanted) {
        const auto [known, isNew] = pyramids.try_emplace(pyramid);
        if (isNew) {
            known->second = placeLevels(pyramid);
        }
        const std::vector<TextureLevel>& levels = known->second;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            target.textures[record + 1 + i].level = levels[i];
        }
        target.textures[record].use.flags |= static_cast<std::uint32_t>(levels.size())
                                             << kTextureLastLevelShift;
        target.features |= levels.empty() ? 0u : kFeatureMipmaps;
    }
}

std::vector<TextureLevel> TexelStore::placeLevels(const Pyramid& pyramid) {
    const auto [imageId, isSrgb, weight] = pyramid;
    const TextureImage& image = scene.images[imageId];
    std::vector<std::uint32_t> words;
    std::vector<TextureLevel> levels;
    for (const MipLevel& level : makeMipLevels(image, isSrgb, weight)) {
        const TexelPlace inPyramid{0, static_cast<std::uint32_t>(words.size())};
        // Half floats have enough precision for linear light.
        levels.push_back(
            makeLevel(level.width, level.height, inPyramid, isSrgb && !isDeep(image), isDeep(image)));
        const std::vector<std::uint32_t> texels = isDeep(image) ? halvesOf(level) : bytesOf(level, isSrgb);
        words.insert(words.end(), texels.begin(), texels.end());
    }
    const std::optional<TexelPlace> found = place(words);
    if (!found) {
        return {};
    }
    for (TextureLevel& level : levels) {
        level.firstWord += found->firstWord;
        level.format |= found->chunk << kTexelsChunkShift;
    }
    return levels;
}

glm::vec4 TexelStore::meanOf(const TextureRef& ref) const {
    if (ref.texture == kNoTexture) {
        return glm::vec4(1.0f);
    }
    const TextureImage& image = scene.images[scene.textures[ref.texture].image];
    const std::size_t count = std::max(image.bytes.size(), image.floats.size());
    const TexelReader texels(image, ref.isSrgb);
    glm::dvec4 sum(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        sum += texels[i];
    }
    return glm::vec4(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

} // namespace metamarch
