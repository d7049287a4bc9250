// The uniform grid.
#ifndef METAMARCH_LIB_UNIFORM_GRID_GLSL
#define METAMARCH_LIB_UNIFORM_GRID_GLSL
#include "lib/scene.glsl"
#include "shared/grid_walk.h"

layout(std140, binding = kBindGrid) uniform GridBuffer { Grid grid; };
layout(std430, binding = kBindGridCells) readonly buffer GridCellBuffer { uvec2 gridCellWords[]; };

GridCell loadGridCell(const uint index) {
    const uvec2 words = gridCellWords[index];
    return GridCell(words.x, words.y);
}
#endif
