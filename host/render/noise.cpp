// SPDX-License-Identifier: MIT
#include "metamarch/render/noise.h"

#include "metamarch/shared/math.h"

#include <cmath>

namespace metamarch::render {

std::optional<Luminance> luminanceOf(const FilmPixel& pixel) {
    const auto count = static_cast<double>(pixel.samples - pixel.rejected);
    if (count < 2.0) {
        return std::nullopt;
    }
    const glm::dvec3 mean = glm::dvec3(pixel.radiance) / count;
    const glm::dvec3 spread = glm::max(glm::dvec3(pixel.squares) / count - mean * mean, glm::dvec3(0.0));
    const double deviation = luminance(glm::vec3(glm::sqrt(spread)));
    return Luminance{luminance(glm::vec3(mean)), deviation * deviation * count / (count - 1.0)};
}

std::optional<double> noiseOf(const FilmData& film) {
    double light = 0.0;
    double squares = 0.0;
    for (const FilmPixel& pixel : film.pixels) {
        if (const std::optional<Luminance> seen = luminanceOf(pixel)) {
            light += seen->mean;
            squares += seen->variance / (pixel.samples - pixel.rejected);
        }
    }
    const auto pixels = static_cast<double>(film.pixels.size());
    return light > 0.0 && squares > 0.0 ? std::optional(std::sqrt(squares / pixels) / (light / pixels))
                                        : std::nullopt;
}

} // namespace metamarch::render
