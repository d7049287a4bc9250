// SPDX-License-Identifier: MIT
// The tiles of a picture, and the order in which they are drawn.
#ifndef METAMARCH_SHARED_TILE_ORDER_H
#define METAMARCH_SHARED_TILE_ORDER_H
#include "interop.h"

SHARED_BEGIN

// A workgroup has the pixels of a square tile, so that neighbouring invocations trace neighbouring rays.
const uint kTileSide = 8u;
const uint kTilePixels = 64u;

// The pixels of a tile are ordered in blocks of 4 x 2, so that the eight or sixteen lanes of a vector, or the
// 32 of a warp, have a compact part of it.
SHARED_FN uvec2 pixelInTile(const uint i) {
    return uvec2((i & 3u) | ((i >> 1u) & 4u), ((i >> 2u) & 1u) | ((i >> 3u) & 6u));
}

#ifdef __cplusplus
static_assert(kTileSide == 8, "the bits of pixelInTile and placeInTile");
#endif

// Returns the place of a pixel in its tile, the inverse of pixelInTile. x and y may be those in a picture.
SHARED_FN uint placeInTile(const uint x, const uint y) {
    return (x & 3u) | ((y & 1u) << 2u) | ((x & 4u) << 1u) | ((y & 6u) << 3u);
}

// The order in which the tiles of a picture are drawn. Neighbours in this order are far from each other in
// the picture: a submission has tiles from everywhere, so its time tells how long the next one takes. With
// rows from top to bottom, the first one below a cheap sky could take a hundred times as long.
struct TileOrder {
    uint perRow;
    uint rows;
    uint rowStride; // no divisor in common with `rows`
    uint columnStride;
};

// Returns the tile in this place of the order. Tiles are numbered row by row, places from 0 to the number of
// tiles. Places 0 to rows - 1 visit every row once, with columns far apart, and so do the next ones with the
// columns beside them.
SHARED_FN uint tileAt(const TileOrder order, const uint place) {
    const uint i = place % order.rows;
    const uint row = i * order.rowStride % order.rows;
    const uint column = (place / order.rows + i * order.columnStride) % order.perRow;
    return row * order.perRow + column;
}

SHARED_ASSERT_SIZE(TileOrder, 16)

SHARED_END
#endif
