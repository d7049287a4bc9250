// SPDX-License-Identifier: MIT
// Assigns pixels to invocations.
#ifndef METAMARCH_LIB_TILES_GLSL
#define METAMARCH_LIB_TILES_GLSL
#include "shared/tile_order.h"

layout(local_size_x = kTilePixels) in;

// Returns the pixel of this invocation. A workgroup has the tile in one place of the order, an invocation one
// of its pixels. The pixel may be outside the picture.
uvec2 pixelAt(const TileOrder order, const uint place) {
    const uint tile = tileAt(order, place);
    const uvec2 corner = uvec2(tile % order.perRow, tile / order.perRow) * kTileSide;
    return corner + pixelInTile(gl_LocalInvocationIndex);
}
#endif
