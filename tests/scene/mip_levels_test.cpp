// SPDX-License-Identifier: MIT
// The mip levels of textures: means of areas in linear light, and the bytes that store them.
#include "metamarch/shading/texture/mip_levels.h"
#include "metamarch/shading/texture/texel_words.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace metamarch {
namespace {

TextureImage imageOf(const std::uint32_t width, const std::vector<glm::u8vec4>& texels) {
    TextureImage image;
    image.width = width;
    image.height = static_cast<std::uint32_t>(texels.size()) / width;
    image.bytes = texels;
    return image;
}

TextureImage greyOf(const std::uint32_t width, const std::vector<int>& greys) {
    std::vector<glm::u8vec4> texels;
    texels.reserve(greys.size());
    for (const int grey : greys) {
        texels.emplace_back(grey, grey, grey, 255);
    }
    return imageOf(width, texels);
}

std::vector<MipLevel> plainLevels(const TextureImage& image) {
    return makeMipLevels(image, false, ColorWeight::equal);
}

TEST(MipLevels, halveDownToOneTexel) {
    EXPECT_EQ(mipLevelCount(1, 1), 1u);
    EXPECT_EQ(mipLevelCount(2, 1), 2u);
    EXPECT_EQ(mipLevelCount(5, 12), 4u);
    EXPECT_EQ(mipLevelCount(4096, 4096), 13u);
    EXPECT_TRUE(plainLevels(greyOf(1, {7})).empty());
    const std::vector<MipLevel> levels = plainLevels(greyOf(5, std::vector<int>(60, 3)));
    ASSERT_EQ(levels.size(), 3u);
    const glm::uvec2 sizes[] = {{2, 6}, {1, 3}, {1, 1}};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        EXPECT_EQ(glm::uvec2(levels[i].width, levels[i].height), sizes[i]);
        EXPECT_EQ(levels[i].texels.size(), std::size_t{sizes[i].x} * sizes[i].y);
    }
}

TEST(MipLevels, areMeansOfFourTexels) {
    const std::vector<MipLevel> levels = plainLevels(greyOf(4, {0, 51, 102, 255, 102, 51, 0, 255}));
    EXPECT_FLOAT_EQ(levels[0].texels[0].r, 51.0f / 255.0f);
    EXPECT_FLOAT_EQ(levels[0].texels[1].r, 153.0f / 255.0f);
    EXPECT_FLOAT_EQ(levels[1].texels[0].r, 102.0f / 255.0f);
    EXPECT_EQ(levels[1].texels[0].a, 1.0f);
}

// A row of five texels becomes two, each the mean of two and a half; then one.
TEST(MipLevels, divideOddSizesExactly) {
    const std::vector<MipLevel> levels = plainLevels(greyOf(5, {10, 20, 40, 80, 160}));
    EXPECT_FLOAT_EQ(levels[0].texels[0].r * 255.0f, (10.0f + 20.0f + 20.0f) / 2.5f);
    EXPECT_FLOAT_EQ(levels[0].texels[1].r * 255.0f, (20.0f + 80.0f + 160.0f) / 2.5f);
    EXPECT_FLOAT_EQ(levels[1].texels[0].r * 255.0f, 62.0f);
    EXPECT_FLOAT_EQ(plainLevels(greyOf(1, {30, 60, 240})).back().texels[0].r * 255.0f, 110.0f);
}

TEST(MipLevels, keepTheMeanOfTheImage) {
    std::mt19937 random(3);
    for (const glm::uvec2 size :
         {glm::uvec2(7, 5), glm::uvec2(16, 16), glm::uvec2(13, 1), glm::uvec2(3, 31)}) {
        std::vector<int> greys;
        double sum = 0.0;
        for (std::uint32_t i = 0; i < size.x * size.y; ++i) {
            greys.push_back(static_cast<int>(random() % 256u));
            sum += greys.back() / 255.0;
        }
        for (const MipLevel& level : plainLevels(greyOf(size.x, greys))) {
            double levelSum = 0.0;
            for (const glm::vec4& texel : level.texels) {
                levelSum += texel.g;
            }
            EXPECT_NEAR(levelSum / static_cast<double>(level.texels.size()),
                        sum / static_cast<double>(greys.size()), 1e-6);
        }
    }
}

TEST(MipLevels, roundBytesToTheNearest) {
    for (int i = 0; i <= 510; ++i) {
        const float value = static_cast<float>(i) / 510.0f;
        const std::uint32_t byte = bytesOf({1, 1, {glm::vec4(value)}}, false)[0] & 255u;
        EXPECT_EQ(byte, static_cast<std::uint32_t>(std::lround(value * 255.0f))) << value;
    }
}

// If half of the texels are white, the mean has half of the light, which is byte 188 and not 128.
TEST(MipLevels, averageColoursInLinearLight) {
    const std::vector<MipLevel> levels = makeMipLevels(greyOf(2, {0, 255, 255, 0}), true, ColorWeight::equal);
    EXPECT_EQ(levels[0].texels[0], glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
    EXPECT_EQ(bytesOf(levels[0], true)[0], 0xffbcbcbcu);
    EXPECT_EQ(bytesOf(levels[0], false)[0], 0xff808080u);
}

TEST(MipLevels, giveEveryByteBack) {
    for (int byte = 0; byte < 256; ++byte) {
        const TextureImage image =
            imageOf(3, std::vector<glm::u8vec4>(15, glm::u8vec4(static_cast<glm::u8>(byte))));
        for (const bool isSrgb : {false, true}) {
            for (const ColorWeight weight : {ColorWeight::equal, ColorWeight::byAlpha}) {
                for (const MipLevel& level : makeMipLevels(image, isSrgb, weight)) {
                    for (const std::uint32_t word : bytesOf(level, isSrgb)) {
                        ASSERT_EQ(word, 0x01010101u * static_cast<std::uint32_t>(byte));
                    }
                }
            }
        }
    }
}

// A level's byte is the one whose linear value is nearest.
TEST(MipLevels, roundColoursToTheNearestLight) {
    TextureImage bytes = imageOf(1, {glm::u8vec4(0)});
    const auto lightOf = [&](const std::uint32_t byte) {
        bytes.bytes[0] = glm::u8vec4(byte & 255u);
        return TexelReader(bytes, true)[0].r;
    };
    for (int i = -10; i <= 20010; ++i) {
        const float light = static_cast<float>(i) / 20000.0f;
        const std::uint32_t byte = bytesOf({1, 1, {glm::vec4(light)}}, true)[0] & 255u;
        const float error = std::abs(lightOf(byte) - light);
        EXPECT_LE(error, std::abs(lightOf(std::max(byte, 1u) - 1u) - light));
        EXPECT_LE(error, std::abs(lightOf(std::min(byte, 254u) + 1u) - light));
    }
}

TEST(MipLevels, keepDeepTexelsInLinearLight) {
    TextureImage image;
    image.width = 2;
    image.height = 1;
    image.floats = {glm::vec4(0.0f, 1.0f, 4.0f, 1.0f), glm::vec4(1.0f, 1.0f, 8.0f, 0.0f)};
    const std::vector<MipLevel> plain = plainLevels(image);
    EXPECT_EQ(plain[0].texels[0], glm::vec4(0.5f, 1.0f, 6.0f, 0.5f));
    const std::vector<std::uint32_t> words = halvesOf(plain[0]);
    ASSERT_EQ(words.size(), 2u);
    EXPECT_EQ(glm::unpackHalf2x16(words[0]), glm::vec2(0.5f, 1.0f));
    EXPECT_EQ(glm::unpackHalf2x16(words[1]), glm::vec2(6.0f, 0.5f));
    EXPECT_EQ(makeMipLevels(image, true, ColorWeight::equal)[0].texels[0].r, 0.5f);
}

// The black around a green leaf is invisible and does not count; where all is transparent, colours count
// equally.
TEST(MipLevels, colourWhatIsThere) {
    const glm::u8vec4 leaf(0, 255, 0, 255);
    const glm::u8vec4 half(255, 0, 0, 51);
    const glm::u8vec4 hole(0, 0, 0, 0);
    const auto meanOf = [](const glm::u8vec4 a, const glm::u8vec4 b, const ColorWeight weight) {
        return makeMipLevels(imageOf(2, {a, b}), false, weight)[0].texels[0];
    };
    EXPECT_EQ(meanOf(leaf, hole, ColorWeight::byAlpha), glm::vec4(0.0f, 1.0f, 0.0f, 0.5f));
    EXPECT_EQ(meanOf(leaf, hole, ColorWeight::equal), glm::vec4(0.0f, 0.5f, 0.0f, 0.5f));
    EXPECT_EQ(meanOf(hole, glm::u8vec4(255, 255, 255, 0), ColorWeight::byAlpha),
              glm::vec4(0.5f, 0.5f, 0.5f, 0.0f));
    const glm::vec4 mixed = meanOf(leaf, half, ColorWeight::byAlpha);
    EXPECT_FLOAT_EQ(mixed.r, 0.2f / 1.2f);
    EXPECT_FLOAT_EQ(mixed.g, 1.0f / 1.2f);
    EXPECT_FLOAT_EQ(mixed.a, 0.6f);
}

// A leaf in the corner of a large hole: the hole has the leaf's colour in every level.
TEST(MipLevels, colourHolesAsWhatIsAroundThem) {
    std::vector<glm::u8vec4> texels(128, glm::u8vec4(255, 0, 255, 0));
    texels[0] = glm::u8vec4(0, 255, 0, 255);
    for (const MipLevel& level : makeMipLevels(imageOf(16, texels), true, ColorWeight::byAlpha)) {
        for (const glm::vec4& texel : level.texels) {
            EXPECT_EQ(glm::vec3(texel), glm::vec3(0.0f, 1.0f, 0.0f));
        }
        EXPECT_EQ(level.texels.back().a > 0.0f, level.texels.size() == 1);
    }
}

// The mean of two normals that lean apart is upright and shorter than they are.
TEST(MipLevels, averageNormalsAsVectors) {
    TextureImage image;
    image.width = 2;
    image.height = 1;
    const glm::vec3 left(-0.6f, 0.0f, 0.8f);
    const glm::vec3 right(0.6f, 0.0f, 0.8f);
    image.floats = {glm::vec4(left * 0.5f + 0.5f, 1.0f), glm::vec4(right * 0.5f + 0.5f, 1.0f)};
    const glm::vec3 mean = glm::vec3(plainLevels(image)[0].texels[0]) * 2.0f - 1.0f;
    EXPECT_NEAR(glm::length(mean - glm::vec3(0.0f, 0.0f, 0.8f)), 0.0f, 1e-6f);
}

} // namespace
} // namespace metamarch
