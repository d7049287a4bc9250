// SPDX-License-Identifier: MIT
// Which pixel an invocation works on.
#ifndef METAMARCH_LIB_TILES_GLSL
#define METAMARCH_LIB_TILES_GLSL
#include "shared/primary.h"

layout(local_size_x = kTilePixels) in;

// A workgroup has a tile, an invocation one of its pixels, which may lie beyond the picture's edges. Tiles
// are numbered in rows.
uvec2 pixelOfTile(const uint tile, const uint tilesPerRow) {
    const uvec2 inTile = uvec2(gl_LocalInvocationIndex % kTileSide, gl_LocalInvocationIndex / kTileSide);
    return uvec2(tile % tilesPerRow, tile / tilesPerRow) * kTileSide + inTile;
}
#endif
