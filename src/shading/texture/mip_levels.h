// The smaller levels of a texture: each is half as large as the one before, down to one texel.
#pragma once
#include "metamarch/scene/texture.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace metamarch {

// What the colours of several texels weigh in their mean. Of a surface with holes only what is there has a
// colour that anyone sees; holes get that of what is around them.
enum class ColorWeight { equal, byAlpha };

struct MipLevel {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<glm::vec4> texels; // in linear light, alpha not multiplied in
};

// How many levels an image of that size has, itself included.
std::uint32_t mipLevelCount(std::uint32_t width, std::uint32_t height);

// Levels 1 and on; none for a single texel. A texel is the mean of the area that it covers of the level
// before, of odd sizes in parts, so that every level has the mean of the image. Vectors that are encoded as
// 0.5 + v / 2, such as normals, so become means of vectors, shorter where they disagree.
std::vector<MipLevel> makeMipLevels(const TextureImage& image, bool isSrgb, ColorWeight weight);

} // namespace metamarch
