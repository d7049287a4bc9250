// SPDX-License-Identifier: MIT
#include "metamarch/image/film_image.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace metamarch {

Image filmImage(const FilmData& film, const std::span<const SeenPoint> seen, const int width,
                const int height, const std::span<const Aov> written, const float missDepth) {
    if (film.pixels.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        throw std::invalid_argument("filmImage: the film has another size");
    }
    std::vector<std::string> names;
    std::vector<std::string> idNames;
    std::vector<glm::length_t> sizes;
    std::vector<Aov> rows;
    std::ranges::copy_if(written, std::back_inserter(rows),
                         [](const Aov& aov) { return !aov.isCryptomatte(); });
    for (const Aov& aov : rows) {
        const std::vector<std::string> channels = aov.channels();
        std::vector<std::string>& list = aov.id != nullptr ? idNames : names;
        list.insert(list.end(), channels.begin(), channels.end());
        sizes.push_back(static_cast<glm::length_t>(channels.size()));
    }
    Image image(width, height, std::move(names), std::move(idNames));
    float* out = image.pixels.data();
    std::uint32_t* idOut = image.ids.data();
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const AovPixel pixel{film.pixels[i], film.light.empty() ? noLight() : film.light[i],
                             seen.empty() ? SeenPoint{} : seen[i], missDepth};
        for (std::size_t row = 0; row < rows.size(); ++row) {
            if (rows[row].id != nullptr) {
                *idOut++ = rows[row].id(pixel);
                continue;
            }
            const glm::vec3 value = rows[row].value(pixel);
            for (glm::length_t channel = 0; channel < sizes[row]; ++channel) {
                *out++ = value[channel];
            }
        }
    }
    return image;
}

} // namespace metamarch
