// SPDX-License-Identifier: MIT
#include "metamarch/scene/texture/height_map.h"

namespace metamarch {
namespace {

glm::vec3 texelOf(const TextureImage& image, std::size_t i) {
    return image.floats.empty() ? glm::vec3(image.bytes[i]) / 255.0f : glm::vec3(image.floats[i]);
}

// Most normals of a normal map point straight up, which is blue.
bool isNormalMap(const TextureImage& image, std::size_t count) {
    constexpr double kBluer = 0.1;
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        sum += texelOf(image, i);
    }
    const glm::dvec3 mean = sum / static_cast<double>(count);
    return mean.b > mean.r + kBluer && mean.b > mean.g + kBluer;
}

} // namespace

void heightsToNormals(TextureImage& image) {
    const std::size_t width = image.width;
    const std::size_t height = image.height;
    if (isNormalMap(image, width * height)) {
        return;
    }
    // In texels, as the differences of places are.
    const float scale = kHeightOfWhite * static_cast<float>(width);
    const auto heightAt = [&](std::size_t x, std::size_t y) {
        const glm::vec3 texel = texelOf(image, y * width + x);
        return scale * (texel.r + texel.g + texel.b) / 3.0f;
    };
    std::vector<glm::vec4> normals;
    normals.reserve(width * height);
    for (std::size_t y = 0; y < height; ++y) {
        const std::size_t above = y > 0 ? y - 1 : height - 1;
        const std::size_t below = y + 1 < height ? y + 1 : 0;
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t left = x > 0 ? x - 1 : width - 1;
            const std::size_t right = x + 1 < width ? x + 1 : 0;
            const glm::vec2 slope((heightAt(right, y) - heightAt(left, y)) / 2.0f,
                                  (heightAt(x, above) - heightAt(x, below)) / 2.0f);
            normals.emplace_back(glm::normalize(glm::vec3(-slope, 1.0f)) * 0.5f + 0.5f, 1.0f);
        }
    }
    image.bytes.clear();
    image.floats = std::move(normals);
}

} // namespace metamarch
