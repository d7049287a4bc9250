#include "metamarch/image/film_image.h"

#include <algorithm>
#include <limits>

namespace metamarch {

Image filmImage(const std::span<const FilmPixel> film, const int width, const int height) {
    Image image(width, height,
                {"R",        "G",          "B",          "A",          "Z",           "t",        "N.X",
                 "N.Y",      "N.Z",        "Ns.X",       "Ns.Y",       "Ns.Z",        "albedo.R", "albedo.G",
                 "albedo.B", "variance.R", "variance.G", "variance.B", "id.triangle", "steps",    "tests"});
    float* out = image.pixels.data();
    for (const FilmPixel& pixel : film) {
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        const bool isMiss = pixel.triangleId == kNoTriangle;
        const auto count = static_cast<float>(std::max(pixel.samples - pixel.rejected, 1u));
        const auto taken = static_cast<float>(std::max(pixel.samples, 1u));
        const glm::vec3 color = meanRadiance(pixel);
        const glm::vec3 normal = pixel.normal / count;
        const glm::vec3 shadingNormal = pixel.shadingNormal / count;
        const glm::vec3 albedo = pixel.albedo / count;
        const glm::vec3 spread = glm::max(pixel.squares / count - color * color, glm::vec3(0.0f));
        const glm::vec3 variance = spread / std::max(count - 1.0f, 1.0f);
        const float values[] = {color.r,
                                color.g,
                                color.b,
                                pixel.covered / count,
                                isMiss ? kInfinity : pixel.depth,
                                isMiss ? kInfinity : pixel.t,
                                normal.x,
                                normal.y,
                                normal.z,
                                shadingNormal.x,
                                shadingNormal.y,
                                shadingNormal.z,
                                albedo.r,
                                albedo.g,
                                albedo.b,
                                variance.r,
                                variance.g,
                                variance.b,
                                isMiss ? -1.0f : static_cast<float>(pixel.triangleId),
                                pixel.steps / taken,
                                pixel.tests / taken};
        out = std::copy(std::begin(values), std::end(values), out);
    }
    return image;
}

} // namespace metamarch
