// SPDX-License-Identifier: MIT
#include "metamarch/shading/texture/texel_words.h"

#include "metamarch/shared/texture.h"

#include <glm/gtc/packing.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace metamarch {
namespace {

using ByteValues = std::array<float, 256>;

// Returns the values of the 256 bytes in ascending order, in linear light.
const ByteValues& valuesOfBytes(const bool isSrgb) {
    static const std::array<ByteValues, 2> kValues = [] {
        std::array<ByteValues, 2> values{};
        for (std::size_t i = 0; i < values[0].size(); ++i) {
            values[0][i] = static_cast<float>(i) / 255.0f;
            values[1][i] = srgbToLinear(glm::vec3(values[0][i])).x;
        }
        return values;
    }();
    return kValues[isSrgb ? 1 : 0];
}

// Returns, for each part of [0, 1], the first byte whose linear value is not below the part's begin.
constexpr std::size_t kGuides = 4096;
const std::array<std::uint8_t, kGuides>& firstBytes() {
    static const std::array<std::uint8_t, kGuides> kFirst = [] {
        std::array<std::uint8_t, kGuides> first{};
        for (std::size_t i = 0; i < kGuides; ++i) {
            const float begin = static_cast<float>(i) / kGuides;
            const auto above = std::ranges::lower_bound(valuesOfBytes(true), begin);
            first[i] = static_cast<std::uint8_t>(above - valuesOfBytes(true).begin());
        }
        return first;
    }();
    return kFirst;
}

// Returns the byte whose linear value is the nearest, the larger one halfway between two.
std::uint32_t srgbByte(const float linear) {
    if (!(linear > 0.0f)) {
        return 0;
    }
    if (linear >= 1.0f) {
        return 255;
    }
    const ByteValues& decoded = valuesOfBytes(true);
    std::uint32_t above = firstBytes()[static_cast<std::size_t>(linear * kGuides)];
    while (above < 255 && decoded[above] < linear) {
        ++above;
    }
    const bool isBelowNearer = linear - decoded[above - 1] < decoded[above] - linear;
    return above - (isBelowNearer ? 1u : 0u);
}

std::uint32_t plainByte(const float value) {
    // A double holds the sum of a float and a half, so this rounds as std::lround does, without a call.
    return static_cast<std::uint32_t>(double{std::clamp(value, 0.0f, 1.0f) * 255.0f} + 0.5);
}

std::uint32_t packed(const glm::uvec4 bytes) {
    return bytes.r | bytes.g << 8u | bytes.b << 16u | bytes.a << 24u;
}

std::vector<std::uint32_t> halves(const std::vector<glm::vec4>& texels) {
    std::vector<std::uint32_t> words;
    words.reserve(texels.size() * 2);
    for (const glm::vec4& texel : texels) {
        constexpr float kLargestHalf = 65504.0f;
        const glm::vec4 bounded = glm::clamp(texel, glm::vec4(-kLargestHalf), glm::vec4(kLargestHalf));
        words.push_back(glm::packHalf2x16({bounded.r, bounded.g}));
        words.push_back(glm::packHalf2x16({bounded.b, bounded.a}));
    }
    return words;
}

} // namespace

TexelReader::TexelReader(const TextureImage& usedImage, const bool isSrgb)
    : image(usedImage), hasSrgb(isSrgb), colors(valuesOfBytes(isSrgb)), alphas(valuesOfBytes(false)) {}

glm::vec4 TexelReader::deepTexel(const std::size_t i) const {
    const glm::vec4 texel = image.floats[i];
    return hasSrgb ? glm::vec4(srgbToLinear(glm::vec3(texel)), texel.a) : texel;
}

std::vector<std::uint32_t> wordsOf(const TextureImage& image) {
    if (isDeep(image)) {
        return halves(image.floats);
    }
    std::vector<std::uint32_t> words(image.bytes.size());
    std::ranges::transform(image.bytes, words.begin(),
                           [](const glm::u8vec4 texel) { return packed(glm::uvec4(texel)); });
    return words;
}

std::vector<std::uint32_t> bytesOf(const MipLevel& level, const bool isSrgb) {
    const auto byteOf = isSrgb ? srgbByte : plainByte;
    std::vector<std::uint32_t> words(level.texels.size());
    constexpr std::size_t kGrain = 4096; // texels
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, words.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const glm::vec4& texel = level.texels[i];
            words[i] = packed({byteOf(texel.r), byteOf(texel.g), byteOf(texel.b), plainByte(texel.a)});
        }
    });
    return words;
}

std::vector<std::uint32_t> halvesOf(const MipLevel& level) { return halves(level.texels); }

} // namespace metamarch
