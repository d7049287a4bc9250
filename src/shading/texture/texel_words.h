// SPDX-License-Identifier: MIT
// Encodes texels in the words that shaders read.
#pragma once
#include "metamarch/scene/texture.h"
#include "metamarch/shading/texture/mip_levels.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// Returns true if a texel takes two words of half floats; otherwise it takes one word of bytes.
inline bool isDeep(const TextureImage& image) { return image.bytes.empty(); }

// Reads texels of an image as texelAt() of shared/texture.h decodes them.
class TexelReader {
  public:
    TexelReader(const TextureImage& usedImage, bool isSrgb);

    glm::vec4 operator[](const std::size_t i) const {
        if (isDeep(image)) {
            return deepTexel(i);
        }
        const glm::u8vec4 texel = image.bytes[i];
        return {colors[texel.r], colors[texel.g], colors[texel.b], alphas[texel.a]};
    }

  private:
    glm::vec4 deepTexel(std::size_t i) const;

    const TextureImage& image;
    bool hasSrgb;
    std::span<const float, 256> colors; // values of the bytes
    std::span<const float, 256> alphas;
};

// Encodes the texels as the file stores them.
std::vector<std::uint32_t> wordsOf(const TextureImage& image);

// Encodes a level as bytes; colours are rounded to the nearest sRGB value if `isSrgb`.
std::vector<std::uint32_t> bytesOf(const MipLevel& level, bool isSrgb);

// Encodes a level as half floats in linear light.
std::vector<std::uint32_t> halvesOf(const MipLevel& level);

} // namespace metamarch
