// SPDX-License-Identifier: MIT
// Divides a picture into tiles and orders them.
#pragma once
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film_data.h"
#include "metamarch/shared/tile_order.h"

#include <cstddef>
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

    // Calls `visit` with each pixel of the tile at this place of the order that is in the picture: its number
    // in the tile, and its index in the picture.
    template <class Visit>
    void forEachPixelAt(const std::uint32_t place, const Visit& visit) const {
        const std::uint32_t tile = tileAt(order, place);
        const uvec2 corner = uvec2(tile % order.perRow, tile / order.perRow) * kTileSide;
        for (std::uint32_t i = 0; i < kTilePixels; ++i) {
            const uvec2 pixel = corner + pixelInTile(i);
            if (pixel.x < size.x && pixel.y < size.y) {
                visit(i, std::size_t{pixel.y} * size.x + pixel.x);
            }
        }
    }

    uvec2 size; // of the picture
    TileOrder order;
    std::uint32_t count;
};

} // namespace metamarch::render
