// SPDX-License-Identifier: MIT
// Loads the uniform grid.
#ifndef METAMARCH_LIB_UNIFORM_GRID_GLSL
#define METAMARCH_LIB_UNIFORM_GRID_GLSL
#include "lib/scene.glsl"
#include "shared/grid_walk.h"

layout(std140, binding = kBindGrid) uniform GridBuffer { Grid grid; };
WORDS2(gridCellWords, kBindGridCells);

GridCell loadGridCell(const uint index) {
    const uvec2 words = LOAD2(gridCellWords, index);
    return GridCell(words.x, words.y);
}
#endif
