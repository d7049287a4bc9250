// Texels in the words that shaders read.
#pragma once
#include "metamarch/scene/texture.h"
#include "metamarch/shading/texture/mip_levels.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace metamarch {

// Two words a texel, of halves; else one, of bytes.
inline bool isDeep(const TextureImage& image) { return image.bytes.empty(); }

// Texel `i` of the image as texelAt() of shared/texture.h decodes it.
glm::vec4 linearTexel(const TextureImage& image, std::size_t i, bool isSrgb);

// As the file has them.
std::vector<std::uint32_t> wordsOf(const TextureImage& image);

// Bytes, of colours the nearest to linear light that sRGB has.
std::vector<std::uint32_t> bytesOf(const MipLevel& level, bool isSrgb);

// Halves, in linear light.
std::vector<std::uint32_t> halvesOf(const MipLevel& level);

} // namespace metamarch
