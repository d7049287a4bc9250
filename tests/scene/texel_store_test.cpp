// SPDX-License-Identifier: MIT
// Textures in the shaders' layout: filters, levels and storage.
#include "fixtures/expect_error.h"
#include "metamarch/shading/texture/texel_store.h"
#include "metamarch/shading/texture/texel_words.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

constexpr std::uint64_t kRoom = 1u << 20u;

// Returns a scene with one image of `side` * `side` different texels and one texture of it.
Scene sceneOf(const std::uint32_t side, const TextureFilter mag, const TextureFilter min) {
    Scene scene;
    TextureImage image;
    image.name = "made";
    image.width = side;
    image.height = side;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        image.bytes.emplace_back(i, 2 * i, 255 - i, i % 2 * 255);
    }
    scene.images.push_back(image);
    scene.textures.push_back({.magFilter = mag, .minFilter = min});
    return scene;
}

ShadingScene stored(const Scene& scene, const TextureRef& ref, const std::uint64_t chunkBytes = kRoom) {
    ShadingScene target;
    TexelStore store(scene, chunkBytes, target);
    EXPECT_EQ(store.add(ref), 0u);
    store.addLevels();
    return target;
}

struct Mode {
    TextureFilter filter;
    std::uint32_t flags; // flags of the minification filter
    bool hasLevels;
};

constexpr Mode kModes[] = {
    {TextureFilter::nearest, kTextureMinifiedNearest, false},
    {TextureFilter::linear, 0, false},
    {TextureFilter::nearestMipmapNearest, kTextureMinifiedNearest, true},
    {TextureFilter::linearMipmapNearest, 0, true},
    {TextureFilter::nearestMipmapLinear, kTextureMinifiedNearest | kTextureBetweenLevels, true},
    {TextureFilter::linearMipmapLinear, kTextureBetweenLevels, true},
};

TEST(TexelStore, hasEveryFilterOfGltf) {
    for (const TextureFilter mag : {TextureFilter::nearest, TextureFilter::linear}) {
        for (const Mode& mode : kModes) {
            const ShadingScene target = stored(sceneOf(8, mag, mode.filter), {0});
            const bool isNearest = mag == TextureFilter::nearest;
            const bool isMinifiedNearest = (mode.flags & kTextureMinifiedNearest) != 0;
            const std::uint32_t levels = mode.hasLevels ? 3u << kTextureLastLevelShift : 0u;
            EXPECT_EQ(target.textures[0].use.flags, mode.flags | (isNearest ? kTextureNearest : 0u) | levels);
            // Textures that do not need the size of the footprint must not enable the feature.
            const bool isAsked = mode.hasLevels || isNearest != isMinifiedNearest;
            EXPECT_EQ((target.features & kFeatureMipmaps) != 0, isAsked);
            EXPECT_EQ(target.textures.size(), mode.hasLevels ? 4u : 1u);
            EXPECT_EQ(target.texels[0].size(), mode.hasLevels ? 64u + 16u + 4u + 1u : 64u);
        }
    }
}

TEST(TexelStore, asksForNoLevelsOfASingleTexel) {
    const ShadingScene target =
        stored(sceneOf(1, TextureFilter::linear, TextureFilter::linearMipmapLinear), {0});
    EXPECT_EQ(target.features, kFeatureTextures);
    EXPECT_EQ(target.texels[0].size(), 1u);
}

TEST(TexelStore, placesTheLevelsInTheirRecords) {
    const Scene scene = sceneOf(4, TextureFilter::linear, TextureFilter::linearMipmapLinear);
    const ShadingScene target = stored(scene, {.texture = 0, .isSrgb = true});
    const std::vector<MipLevel> levels = makeMipLevels(scene.images[0], true, ColorWeight::equal);
    const std::uint32_t sides[] = {4, 2, 1};
    const std::uint32_t firsts[] = {0, 16, 20};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const TextureLevel level = target.textures[i].level;
        EXPECT_EQ(level.width, sides[i]);
        EXPECT_EQ(level.height, sides[i]);
        EXPECT_EQ(level.firstWord, firsts[i]);
        EXPECT_EQ(level.format, kTexelsSrgb);
    }
    for (std::uint32_t i = 0; i < 2; ++i) {
        const std::vector<std::uint32_t> words = bytesOf(levels[i], true);
        for (std::size_t j = 0; j < words.size(); ++j) {
            EXPECT_EQ(target.texels[0][firsts[i + 1] + j], words[j]);
        }
    }
}

TEST(TexelStore, keepsDeepLevelsInLinearLight) {
    Scene scene = sceneOf(2, TextureFilter::linear, TextureFilter::linearMipmapLinear);
    scene.images[0].bytes.clear();
    scene.images[0].floats.assign(4, glm::vec4(0.5f));
    const ShadingScene target = stored(scene, {.texture = 0, .isSrgb = true});
    EXPECT_EQ(target.textures[0].level.format, kTexelsDeep | kTexelsSrgb);
    EXPECT_EQ(target.textures[1].level.format, kTexelsDeep);
    EXPECT_EQ(target.textures[1].level.firstWord, 8u);
}

TEST(TexelStore, countsTexelsOfTheTransformedSquare) {
    const Scene scene = sceneOf(8, TextureFilter::linear, TextureFilter::linearMipmapLinear);
    const auto unitLevel = [&](const glm::mat3x2& transform) {
        return stored(scene, {.texture = 0, .transform = transform}).textures[0].use.unitLevel;
    };
    EXPECT_EQ(unitLevel({1, 0, 0, 1, 0, 0}), 3.0f);
    EXPECT_EQ(unitLevel({0, 4, -4, 0, 7, 8}), 5.0f);    // a quarter turn, four repetitions
    EXPECT_EQ(unitLevel({-2, 0, 0, 0.5f, 1, 1}), 3.0f); // mirrored, which keeps the area
    EXPECT_LT(unitLevel({1, 1, 1, 1, 0, 0}), -40.0f);   // collapsed to a line
}

// References share texels and levels unless they average them differently.
TEST(TexelStore, storesWhatIsAlikeOnce) {
    const Scene scene = sceneOf(4, TextureFilter::linear, TextureFilter::linearMipmapLinear);
    ShadingScene target;
    TexelStore store(scene, kRoom, target);
    const TextureRef color{.texture = 0, .isSrgb = true};
    const std::uint32_t first = store.add(color);
    const std::uint32_t again = store.add(color);
    const std::uint32_t leaf = store.add(color, ColorWeight::byAlpha);
    const std::uint32_t plain = store.add({.texture = 0});
    store.addLevels();
    EXPECT_EQ(target.texels[0].size(), 16u + 3 * 5u);
    const auto levelAt = [&](const std::uint32_t record, const std::uint32_t level) {
        return target.textures[record + level].level.firstWord;
    };
    for (const std::uint32_t record : {again, leaf, plain}) {
        EXPECT_EQ(levelAt(record, 0), levelAt(first, 0));
    }
    EXPECT_EQ(levelAt(again, 1), levelAt(first, 1));
    EXPECT_NE(levelAt(leaf, 1), levelAt(first, 1));
    EXPECT_NE(levelAt(plain, 1), levelAt(first, 1));
}

TEST(TexelStore, refusesNoSceneForItsLevels) {
    Scene scene = sceneOf(8, TextureFilter::linear, TextureFilter::nearestMipmapLinear);
    const ShadingScene full = stored(scene, {0}, 256);
    EXPECT_EQ(full.textures[0].use.flags >> kTextureLastLevelShift, 3u);
    EXPECT_EQ(full.textures[1].level.format, 1u << kTexelsChunkShift); // in the next chunk, which has room
    EXPECT_EQ(full.textures[1].level.firstWord, 0u);

    for (std::uint32_t i = 1; i < kTexelChunks; ++i) {
        scene.images.push_back(scene.images[0]);
        scene.textures.push_back({.image = i});
    }
    ShadingScene target;
    TexelStore store(scene, 256, target);
    for (std::uint32_t i = 0; i < kTexelChunks; ++i) {
        store.add({.texture = i});
    }
    store.addLevels();
    EXPECT_EQ(target.textures[0].use.flags, kTextureMinifiedNearest | kTextureBetweenLevels);

    scene.images.push_back(scene.images[0]);
    scene.images.back().name = "the last";
    scene.textures.push_back({.image = kTexelChunks});
    expectError(ErrorKind::outOfMemory, "the last with 8 x 8 texels is one too many",
                [&] { store.add({.texture = kTexelChunks}); });
}

} // namespace
} // namespace metamarch
