// SPDX-License-Identifier: MIT
#include "metamarch/shading/texture/mip_levels.h"

#include "metamarch/shading/texture/texel_words.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>

namespace metamarch {
namespace {

// The 2 to 4 texels of a row or column that one texel of the next level covers.
struct Cover {
    std::uint32_t first;
    std::uint32_t count;
    std::array<float, 4> weights; // sum to 1
};

// A row of `from` texels is as long as a row of `to` texels. Lengths are counted in units of 1 / (from * to)
// of the row, in which the ends of all texels are integers.
Cover coverOf(const std::uint64_t i, const std::uint64_t from, const std::uint64_t to) {
    const std::uint64_t begin = i * from;
    const std::uint64_t end = begin + from;
    Cover cover{static_cast<std::uint32_t>(begin / to), 0, {}};
    for (std::uint64_t texel = cover.first; texel * to < end; ++texel) {
        const std::uint64_t covered = std::min(end, (texel + 1) * to) - std::max(begin, texel * to);
        cover.weights[cover.count++] = static_cast<float>(covered) / static_cast<float>(from);
    }
    return cover;
}

// `Count` is the number of rows and of columns, as a constant, or 0 where the covers say it.
template <std::uint32_t Count, class TexelAt>
glm::vec4 meanOf(const Cover& columns, const Cover& rows, const ColorWeight weight, const TexelAt& texelAt) {
    const std::uint32_t rowCount = Count != 0 ? Count : rows.count;
    const std::uint32_t columnCount = Count != 0 ? Count : columns.count;
    glm::vec4 sum(0.0f);
    glm::vec3 visible(0.0f);
    for (std::uint32_t j = 0; j < rowCount; ++j) {
        for (std::uint32_t i = 0; i < columnCount; ++i) {
            const float part = rows.weights[j] * columns.weights[i];
            const glm::vec4 texel = texelAt(columns.first + i, rows.first + j);
            sum += part * texel;
            if (weight == ColorWeight::byAlpha) {
                visible += part * texel.a * glm::vec3(texel);
            }
        }
    }
    return weight == ColorWeight::byAlpha && sum.a > 0.0f ? glm::vec4(visible / sum.a, sum.a) : sum;
}

template <class TexelAt>
MipLevel halve(const std::uint32_t width, const std::uint32_t height, const ColorWeight weight,
               const TexelAt& texelAt) {
    MipLevel level{std::max(width / 2, 1u), std::max(height / 2, 1u), {}};
    level.texels.resize(std::size_t{level.width} * level.height);
    std::vector<Cover> columns;
    columns.reserve(level.width);
    for (std::uint32_t x = 0; x < level.width; ++x) {
        columns.push_back(coverOf(x, width, level.width));
    }
    const bool isEven = width % 2 == 0 && height % 2 == 0;
    tbb::parallel_for(0u, level.height, [&](const std::uint32_t y) {
        const Cover rows = coverOf(y, height, level.height);
        glm::vec4* const texels = &level.texels[std::size_t{y} * level.width];
        for (std::uint32_t x = 0; x < level.width; ++x) {
            texels[x] = isEven ? meanOf<2>(columns[x], rows, weight, texelAt)
                               : meanOf<0>(columns[x], rows, weight, texelAt);
        }
    });
    return level;
}

// Gives fully transparent texels the colour of the texel of the next level that covers them, because filters
// mix in neighbouring texels.
void colorHoles(MipLevel& level, const MipLevel& next) {
    for (std::size_t i = 0; i < level.texels.size(); ++i) {
        if (level.texels[i].a == 0.0f) {
            const std::size_t x = i % level.width * next.width / level.width;
            const std::size_t y = i / level.width * next.height / level.height;
            level.texels[i] = glm::vec4(glm::vec3(next.texels[y * next.width + x]), 0.0f);
        }
    }
}

} // namespace

std::uint32_t mipLevelCount(const std::uint32_t width, const std::uint32_t height) {
    return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

std::vector<MipLevel> makeMipLevels(const TextureImage& image, const bool isSrgb, const ColorWeight weight) {
    std::vector<MipLevel> levels;
    const std::uint32_t count = mipLevelCount(image.width, image.height);
    levels.reserve(count);
    while (levels.size() + 1 < count) {
        if (levels.empty()) {
            const TexelReader texels(image, isSrgb);
            levels.push_back(
                halve(image.width, image.height, weight,
                      [&](const std::size_t x, const std::size_t y) { return texels[y * image.width + x]; }));
        } else {
            const MipLevel& last = levels.back();
            levels.push_back(
                halve(last.width, last.height, weight, [&](const std::size_t x, const std::size_t y) {
                    return last.texels[y * last.width + x];
                }));
        }
    }
    for (std::size_t i = levels.size(); weight == ColorWeight::byAlpha && i-- > 1;) {
        colorHoles(levels[i - 1], levels[i]);
    }
    return levels;
}

} // namespace metamarch
