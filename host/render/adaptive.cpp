// SPDX-License-Identifier: MIT
#include "metamarch/render/adaptive.h"

#include "metamarch/render/noise.h"
#include "metamarch/shared/math.h"
#include "metamarch/shared/tile_order.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace metamarch::render {
namespace {

// Sums over pixels of one colour of the chessboard.
struct Noise {
    double light = 0.0;  // luminance
    double spread = 0.0; // variance of a sample's luminance
    double pixels = 0.0;

    void add(const Noise& other) {
        light += other.light;
        spread += other.spread;
        pixels += other.pixels;
    }
};

// For each tile, the noise of black and of white pixels.
class NoiseOfTiles {
  public:
    NoiseOfTiles(const FilmData& film, const std::uint32_t width)
        : columns_((width + kTileSide - 1) / kTileSide) {
        const auto height = static_cast<std::uint32_t>(film.pixels.size() / width);
        rows_ = (height + kTileSide - 1) / kTileSide;
        tiles_.resize(std::size_t{columns_} * rows_);
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            const auto x = static_cast<std::uint32_t>(i % width);
            const auto y = static_cast<std::uint32_t>(i / width);
            if (const std::optional<Luminance> pixel = luminanceOf(film.pixels[i])) {
                tiles_[tileOf(x, y)][(x + y) % 2].add({pixel->mean, pixel->variance, 1.0});
            }
        }
    }

    // The error after `samples` samples that the pixels of the other colour show around this pixel.
    double errorAt(const std::uint32_t x, const std::uint32_t y, const std::uint32_t samples) const {
        Noise around;
        const std::uint32_t column = x / kTileSide;
        const std::uint32_t row = y / kTileSide;
        for (std::uint32_t r = std::max(row, 1u) - 1; r < std::min(row + 2, rows_); ++r) {
            for (std::uint32_t c = std::max(column, 1u) - 1; c < std::min(column + 2, columns_); ++c) {
                around.add(tiles_[std::size_t{r} * columns_ + c][(x + y + 1) % 2]);
            }
        }
        const double error = std::sqrt(around.spread / around.pixels / samples);
        return around.spread > 0.0 ? error / std::sqrt(around.light / around.pixels) : 0.0;
    }

  private:
    std::size_t tileOf(const std::uint32_t x, const std::uint32_t y) const {
        return std::size_t{y / kTileSide} * columns_ + x / kTileSide;
    }

    std::uint32_t columns_;
    std::uint32_t rows_ = 0;
    std::vector<std::array<Noise, 2>> tiles_;
};

} // namespace

std::vector<std::uint8_t> activePixels(const FilmData& film, const std::uint32_t width,
                                       const std::uint32_t samples, const double threshold) {
    const NoiseOfTiles noise(film, width);
    std::vector<std::uint8_t> active(film.pixels.size(), 0);
    for (std::size_t i = 0; i < active.size(); ++i) {
        const auto x = static_cast<std::uint32_t>(i % width);
        const auto y = static_cast<std::uint32_t>(i / width);
        active[i] = film.pixels[i].samples == samples && noise.errorAt(x, y, samples) > threshold ? 1 : 0;
    }
    return active;
}

} // namespace metamarch::render
