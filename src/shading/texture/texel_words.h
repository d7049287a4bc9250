// SPDX-License-Identifier: MIT
// Encodes texels in the words that shaders read.
#pragma once
#include "metamarch/scene/texture.h"
#include "metamarch/shading/texture/mip_levels.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace metamarch {

// Returns true if a texel takes two words of half floats; otherwise it takes one word of bytes.
inline bool isDeep(const TextureImage& image) { return image.bytes.empty(); }

// Returns texel `i` of the image as texelAt() of shared/texture.h decodes it.
glm::vec4 linearTexel(const TextureImage& image, std::size_t i, bool isSrgb);

// Encodes the texels as the file stores them.
std::vector<std::uint32_t> wordsOf(const TextureImage& image);

// Encodes a level as bytes; colours are rounded to the nearest sRGB value if `isSrgb`.
std::vector<std::uint32_t> bytesOf(const MipLevel& level, bool isSrgb);

// Encodes a level as half floats in linear light.
std::vector<std::uint32_t> halvesOf(const MipLevel& level);

} // namespace metamarch
