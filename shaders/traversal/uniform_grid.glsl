// SPDX-License-Identifier: MIT
// Steps through a uniform grid, cell by cell.
//
// J. Amanatides, A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987, with one
// change: the distances of the next planes come from the cell's integers, where the paper adds up increments
// and their roundings. The grid has a resolution of its own (accel/uniform_grid.h).
//
// Why it ends: each step moves the cell by one in one axis, in the ray's direction, and the loop ends outside
// the grid: at most the sum of the three resolutions in steps, whatever the floats.
//
// What it costs: per step one 8-byte cell, plus the cell's triangles, those that reach into several cells
// again in each. No memory per ray.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#include "lib/uniform_grid.glsl"

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    const Ray gridRay = inGrid(grid, ray);
    ivec3 cell = cellAt(gridRay, ray.tNear, ivec3(0), ivec3(grid.resolution));

    // Holds here: cell lies in the grid, and every triangle that the ray meets before it has been tested.
    while (true) {
        ++trace.steps;
        const GridCell content = loadGridCell(cellIndex(cell, grid.resolution));
        testTriangles(ray, content.firstTriangle, content.triangleCount, trace);
        const BoxExit next = leaveCell(gridRay, cell);
        // A triangle may reach past the cell: only a hit inside it is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= next.t || !isInLattice(next.cell, grid.resolution)) {
            finish(trace);
            return;
        }
        cell = next.cell;
    }
}
