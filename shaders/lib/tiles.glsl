// SPDX-License-Identifier: MIT
// Assigns pixels to invocations.
#ifndef METAMARCH_LIB_TILES_GLSL
#define METAMARCH_LIB_TILES_GLSL
#include "shared/primary.h"

layout(local_size_x = kTilePixels) in;

// Returns the pixel of this invocation. A workgroup has one tile, an invocation one of its pixels. The pixel
// may be outside the picture. Tiles are numbered row by row.
uvec2 pixelOfTile(const uint tile, const uint tilesPerRow) {
    const uvec2 inTile = uvec2(gl_LocalInvocationIndex % kTileSide, gl_LocalInvocationIndex / kTileSide);
    return uvec2(tile % tilesPerRow, tile / tilesPerRow) * kTileSide + inTile;
}
#endif
