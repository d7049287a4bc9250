// SPDX-License-Identifier: MIT
// The uniform grid and the steps through it. The loops are in traversal/uniform_grid.glsl and its CPU twin.
#ifndef METAMARCH_SHARED_GRID_WALK_H
#define METAMARCH_SHARED_GRID_WALK_H
#include "march.h"

SHARED_BEGIN

// A second lattice over the same box, with its own resolution.
struct Grid {
    vec3 scale; // grid cells per cell of the scene's lattice
    uint cellCount;
    uvec3 resolution;
    uint padding;
};

struct GridCell {
    uint firstTriangle;
    uint triangleCount;
};

// Returns the same ray in the grid's space; t is unchanged.
SHARED_FN Ray inGrid(const Grid grid, const Ray ray) {
    Ray moved = ray;
    const vec3 start = ray.start * grid.scale;
    const vec3 stride = ray.stride * grid.scale;
    const vec3 invStride = ray.invStride / grid.scale;
    moved.start = start;
    moved.stride = stride;
    moved.invStride = invStride;
    return moved;
}

// Leaves a cell through the face whose plane comes first, by ordered comparison. Like the march, it computes
// distances from integer planes: a running sum would accumulate one rounding error per cell.
SHARED_FN BoxExit leaveCell(const Ray ray, const ivec3 cell) {
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    const vec3 tPlane = (vec3(mix(cell, cell + 1, upward)) - ray.start) * ray.invStride;
    const bool exitX = tPlane.x <= tPlane.y && tPlane.x <= tPlane.z;
    const bool exitY = !exitX && tPlane.y <= tPlane.z;
    const ivec3 beyond = mix(cell - 1, cell + 1, upward);
    return BoxExit(
        exitX   ? tPlane.x
        : exitY ? tPlane.y
                : tPlane.z,
        ivec3(exitX ? beyond.x : cell.x, exitY ? beyond.y : cell.y, exitX || exitY ? cell.z : beyond.z));
}

SHARED_ASSERT_SIZE(Grid, 32)
SHARED_ASSERT_OFFSET(Grid, cellCount, 12)
SHARED_ASSERT_OFFSET(Grid, resolution, 16)
SHARED_ASSERT_OFFSET(Grid, padding, 28)
SHARED_ASSERT_SIZE(GridCell, 8)
SHARED_ASSERT_OFFSET(GridCell, triangleCount, 4)

SHARED_END
#endif
