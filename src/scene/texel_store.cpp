#include "scene/texel_store.h"

#include "error.h"
#include "scene/texel_words.h"

#include <fmt/format.h>

#include <algorithm>

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

} // namespace

TexelStore::TexelStore(const Scene& usedScene, const std::uint64_t chunkBytes, ShadingScene& usedTarget)
    : scene(usedScene), chunkWords(chunkBytes / sizeof(std::uint32_t)), target(usedTarget) {}

TexelStore::Place TexelStore::placeOf(const std::uint32_t image) {
    const auto known = places.find(image);
    if (known != places.end()) {
        return known->second;
    }
    const std::vector<std::uint32_t> words = wordsOf(scene.images[image]);
    const auto chunk = std::ranges::find_if(
        target.texels, [&](const auto& used) { return used.size() + words.size() <= chunkWords; });
    if (chunk == target.texels.end()) {
        throw Error(
            ExitCode::outOfMemory,
            fmt::format("the scene's textures do not fit {} buffers of {} MiB: {} with {} x {} texels "
                        "is one too many",
                        kTexelChunks, chunkWords * sizeof(std::uint32_t) >> 20u, scene.images[image].name,
                        scene.images[image].width, scene.images[image].height));
    }
    const Place place{static_cast<std::uint32_t>(chunk - target.texels.begin()),
                      static_cast<std::uint32_t>(chunk->size())};
    chunk->insert(chunk->end(), words.begin(), words.end());
    places.emplace(image, place);
    return place;
}

std::uint32_t TexelStore::add(const TextureRef& ref) {
    if (ref.texture == kNoTexture) {
        return kNoTextureRecord;
    }
    const Texture& texture = scene.textures[ref.texture];
    const TextureImage& image = scene.images[texture.image];
    const Place place = placeOf(texture.image);
    TextureRecord record{};
    record.firstWord = place.firstWord;
    record.width = image.width;
    record.height = image.height;
    record.flags = wrapBits(texture.wrapS) | wrapBits(texture.wrapT) << kTextureWrapTShift |
                   (texture.magFilter == TextureFilter::nearest ? kTextureNearest : 0u) |
                   (ref.isSrgb ? kTextureSrgb : 0u) | (isDeep(image) ? kTextureDeep : 0u) |
                   (ref.texCoord == 1 ? kTextureSecondSet : 0u) | place.chunk << kTextureChunkShift;
    record.rowU = {ref.transform[0][0], ref.transform[1][0], ref.transform[2][0]};
    record.rowV = {ref.transform[0][1], ref.transform[1][1], ref.transform[2][1]};
    target.features |= kFeatureTextures | (isDeep(image) ? kFeatureDeepTextures : 0u);
    target.textures.push_back(record);
    return static_cast<std::uint32_t>(target.textures.size() - 1);
}

glm::vec4 TexelStore::meanOf(const TextureRef& ref) const {
    if (ref.texture == kNoTexture) {
        return glm::vec4(1.0f);
    }
    const TextureImage& image = scene.images[scene.textures[ref.texture].image];
    const std::size_t count = std::max(image.bytes.size(), image.floats.size());
    glm::dvec4 sum(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        sum += linearTexel(image, i, ref.isSrgb);
    }
    return glm::vec4(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

} // namespace metamarch
