// SPDX-License-Identifier: MIT
// A film in host memory. C++ only.
#ifndef METAMARCH_SHARED_FILM_DATA_H
#define METAMARCH_SHARED_FILM_DATA_H
#include "film.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// The pixels are in rows from the top.
// A number of samples of a pixel whose first hit is a triangle of one group.
struct HitCount {
    uint group;
    uint samples;
};

// What a film has besides FilmPixel.
struct FilmRequest {
    uint parts = 0;                          // bits kFilm…
    std::span<const std::uint32_t> groups{}; // with kFilmHits, of each triangle
};

struct FilmData {
    FilmData() = default;
    // All pixels are empty. `parts` has bits kFilm….
    FilmData(const std::size_t pixelCount, const uint parts)
        : pixels(pixelCount, emptyPixel()), light((parts & kFilmLight) != 0u ? pixelCount : 0, noLight()),
          hits((parts & kFilmHits) != 0u ? pixelCount : 0) {}

    void addHit(const std::size_t pixel, const uint group) {
        for (HitCount& known : hits[pixel]) {
            if (known.group == group) {
                ++known.samples;
                return;
            }
        }
        hits[pixel].push_back({group, 1});
    }

    std::vector<FilmPixel> pixels;
    std::vector<LightParts> light; // with kFilmLight as many as pixels, otherwise none
    // With kFilmHits as many as pixels, otherwise none. Groups are in any order.
    std::vector<std::vector<HitCount>> hits;
};

} // namespace metamarch
#endif
