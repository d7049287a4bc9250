// SPDX-License-Identifier: MIT
// Makes the mip levels of a texture: each is half as large as the one before, down to one texel.
#pragma once
#include "metamarch/scene/texture.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace metamarch {

// The weights of texels' colours in their mean. On a surface with holes, only opaque texels have a visible
// colour (byAlpha); holes get the colour of their surroundings.
enum class ColorWeight { equal, byAlpha };

struct MipLevel {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<glm::vec4> texels; // linear light, not premultiplied by alpha
};

// Returns the number of levels of an image with this size; the image itself is one of them.
std::uint32_t mipLevelCount(std::uint32_t width, std::uint32_t height);

// Returns levels 1 and up; none for a single texel. A texel is the mean of the area of the previous level
// that it covers. At odd sizes it covers some texels in part, so that every level has the same mean as the
// image. Vectors that are encoded as 0.5 + v / 2, such as normals, are averaged as vectors; the mean is
// shorter where they disagree.
std::vector<MipLevel> makeMipLevels(const TextureImage& image, bool isSrgb, ColorWeight weight);

} // namespace metamarch
