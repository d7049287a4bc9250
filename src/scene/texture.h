// SPDX-License-Identifier: MIT
// Texture images, samplers, and the references of materials to them.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

inline constexpr std::uint32_t kNoTexture = 0xffffffffu;

// Texels as the file stores them, sRGB-encoded or linear; their meaning belongs to their use (TextureRef).
// Grey is copied to r, g and b; a missing alpha is 1; colours are not premultiplied by alpha. Exactly one of
// the two arrays has width * height elements: `bytes` if the file has at most 8 bits per channel, otherwise
// `floats` (integers mapped to [0, 1]). All values are finite.
struct TextureImage {
    std::string name; // path, or the file's element that holds the image; for messages
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::u8vec4> bytes; // row 0 is the top row
    std::vector<glm::vec4> floats;
};

enum class TextureWrap { repeat, mirroredRepeat, clampToEdge };

enum class TextureFilter {
    nearest,
    linear,
    nearestMipmapNearest,
    linearMipmapNearest,
    nearestMipmapLinear,
    linearMipmapLinear
};

// An image and its sampler. (0, 0) is the image's upper left corner, (1, 1) its lower right corner.
struct Texture {
    std::uint32_t image = 0; // index into Scene::images
    TextureWrap wrapS = TextureWrap::repeat;
    TextureWrap wrapT = TextureWrap::repeat;
    TextureFilter magFilter = TextureFilter::linear; // nearest or linear
    TextureFilter minFilter = TextureFilter::linearMipmapLinear;
};

// One use of a texture by a material.
struct TextureRef {
    std::uint32_t texture = kNoTexture; // index into Scene::textures
    std::uint32_t texCoord = 0;         // 0: Scene::texCoords, 1 to 3: Scene::texCoords1 to texCoords3
    bool isSrgb = false; // decode r, g and b from sRGB before any other use; alpha is always linear
    // KHR_texture_transform, two rows of three: texels are looked up at transform * vec3(texCoord, 1).
    glm::mat3x2 transform{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
};

} // namespace metamarch
