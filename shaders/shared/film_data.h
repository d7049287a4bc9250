// SPDX-License-Identifier: MIT
// A film in host memory. C++ only.
#ifndef METAMARCH_SHARED_FILM_DATA_H
#define METAMARCH_SHARED_FILM_DATA_H
#include "film.h"

#include <vector>

namespace metamarch {

// The pixels are in rows from the top.
struct FilmData {
    FilmData() = default;
    // All pixels are empty. `parts` has bits kFilm….
    FilmData(const std::size_t pixelCount, const uint parts)
        : pixels(pixelCount, emptyPixel()), light((parts & kFilmLight) != 0u ? pixelCount : 0, noLight()) {}

    std::vector<FilmPixel> pixels;
    std::vector<LightParts> light; // with kFilmLight as many as pixels, otherwise none
};

} // namespace metamarch
#endif
