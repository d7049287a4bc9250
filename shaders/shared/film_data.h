// SPDX-License-Identifier: MIT
// A film in host memory. C++ only.
#ifndef METAMARCH_SHARED_FILM_DATA_H
#define METAMARCH_SHARED_FILM_DATA_H
#include "film.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// The pixels [left, right) x [top, bottom) of a picture; (0, 0) is top left.
struct PixelRect {
    std::uint32_t left = 0;
    std::uint32_t top = 0;
    std::uint32_t right = 0;
    std::uint32_t bottom = 0;

    std::uint32_t width() const { return right - left; }
    std::uint32_t height() const { return bottom - top; }
    std::size_t pixelCount() const { return std::size_t{width()} * height(); }
    bool operator==(const PixelRect&) const = default;
};

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

    void addHit(const std::size_t pixel, const uint group, const uint samples = 1) {
        for (HitCount& known : hits[pixel]) {
            if (known.group == group) {
                known.samples += samples;
                return;
            }
        }
        hits[pixel].push_back({group, samples});
    }

    // The largest number of samples of a pixel.
    std::uint32_t samples() const {
        std::uint32_t most = 0;
        for (const FilmPixel& pixel : pixels) {
            most = most < pixel.samples ? pixel.samples : most;
        }
        return most;
    }

    std::uint32_t parts() const {
        return (light.empty() ? 0u : kFilmLight) | (hits.empty() ? 0u : kFilmHits);
    }

    std::vector<FilmPixel> pixels;
    std::vector<LightParts> light; // with kFilmLight as many as pixels, otherwise none
    // With kFilmHits as many as pixels, otherwise none. Groups are in any order.
    std::vector<std::vector<HitCount>> hits;
};

// Adds to a pixel of `sums` a pixel of what was taken after it.
inline void addAt(FilmData& sums, const std::size_t pixel, const FilmData& added, const std::size_t from) {
    if (!sums.light.empty()) {
        sums.light[pixel] = addPixelLight(sums.pixels[pixel], sums.light[pixel], added.light[from]);
    }
    if (!sums.hits.empty()) {
        for (const HitCount& hit : added.hits[from]) {
            sums.addHit(pixel, hit.group, hit.samples);
        }
    }
    sums.pixels[pixel] = addPixel(sums.pixels[pixel], added.pixels[from]);
}

// Adds to the sums of earlier blocks those of the block after them, pixel by pixel.
inline void addBlock(FilmData& sums, const FilmData& block) {
    for (std::size_t i = 0; i < sums.pixels.size(); ++i) {
        if (block.pixels[i].samples > 0) {
            addAt(sums, i, block, i);
        }
    }
}

} // namespace metamarch
#endif
