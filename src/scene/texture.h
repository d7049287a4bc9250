// Pictures that materials are painted with, and how a material looks one up.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

inline constexpr std::uint32_t kNoTexture = 0xffffffffu;

// Texels as the file stores them, sRGB-encoded or linear: what they mean is a property of their use
// (TextureRef). Grey is spread over r, g and b; a missing alpha is 1; alpha is not multiplied in. Exactly one
// of the two arrays has width * height elements: bytes where the file has at most 8 bits per channel, floats
// otherwise (integers in [0, 1]), all finite.
struct TextureImage {
    std::string name; // path, or the element of the file that holds it: for messages
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::u8vec4> bytes; // row 0 is the top one
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

// An image and its sampler. (0, 0) is the image's upper left corner, (1, 1) its lower right one.
struct Texture {
    std::uint32_t image = 0; // into Scene::images
    TextureWrap wrapS = TextureWrap::repeat;
    TextureWrap wrapT = TextureWrap::repeat;
    TextureFilter magFilter = TextureFilter::linear; // nearest or linear
    TextureFilter minFilter = TextureFilter::linearMipmapLinear;
};

// One use of a texture by a material.
struct TextureRef {
    std::uint32_t texture = kNoTexture; // into Scene::textures
    std::uint32_t texCoord = 0;         // 0: Scene::texCoords, 1: Scene::texCoords1
    bool isSrgb = false; // r, g, b are to be decoded to linear light before anything else; a never
    // KHR_texture_transform, two rows of three: what is looked up is transform * vec3(texCoord, 1).
    glm::mat3x2 transform{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
};

} // namespace metamarch
