// SPDX-License-Identifier: MIT
#include "metamarch/image/film_image.h"

namespace metamarch {

Image filmImage(const std::span<const FilmPixel> film, const int width, const int height,
                const std::span<const Aov> written) {
    std::vector<std::string> names;
    std::vector<glm::length_t> sizes;
    for (const Aov& aov : written) {
        const std::vector<std::string> channels = aov.channels();
        names.insert(names.end(), channels.begin(), channels.end());
        sizes.push_back(static_cast<glm::length_t>(channels.size()));
    }
    Image image(width, height, std::move(names));
    float* out = image.pixels.data();
    for (const FilmPixel& pixel : film) {
        for (std::size_t i = 0; i < written.size(); ++i) {
            const glm::vec3 value = written[i].value(pixel);
            for (glm::length_t channel = 0; channel < sizes[i]; ++channel) {
                *out++ = value[channel];
            }
        }
    }
    return image;
}

} // namespace metamarch
