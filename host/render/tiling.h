// SPDX-License-Identifier: MIT
// Divides a picture into tiles and orders them.
#pragma once
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film_data.h"
#include "metamarch/shared/tile_order.h"

#include <cstdint>

namespace metamarch::render {

// The tiles [first, end) of a picture, in the order in which they are drawn (shared/tile_order.h).
struct TileRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;

    std::uint32_t count() const { return end - first; }
};

// The tiles of a picture, or of an area of it.
struct Tiling {
    explicit Tiling(const Camera& camera);
    explicit Tiling(const PixelRect& area);

    TileOrder order;
    std::uint32_t count;
};

} // namespace metamarch::render
