// SPDX-License-Identifier: MIT
// Steps through a uniform grid, cell by cell.
//
// J. Amanatides, A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987, with one
// change: the distances of the next planes are computed from the cell's integers. The paper adds increments,
// whose rounding errors accumulate. The grid has its own resolution (accel/uniform_grid.h).
//
// Why it ends: each step moves the cell by one on one axis, in the ray's direction, and the loop ends outside
// the grid. So there are at most as many steps as the sum of the three resolutions, whatever the rounding
// errors.
//
// Cost per step: one 8-byte cell and the cell's triangles. A triangle in several cells is tested again in
// each. No memory per ray.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#include "lib/uniform_grid.glsl"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    const Ray gridRay = inGrid(grid, ray);
    ivec3 cell = cellAt(gridRay, ray.tNear, ivec3(0), ivec3(grid.resolution));

    // Invariant: `cell` is in the grid, and every triangle that the ray meets before it has been tested.
    bool isOn = true;
    uint left = 1u;
    while (isOn) {
        ++trace.steps;
        const GridCell content = loadGridCell(cellIndex(cell, grid.resolution));
        testTriangles(ray, content.firstTriangle, content.triangleCount, trace);
        const BoxExit next = leaveCell(gridRay, cell);
        // A triangle may extend beyond the cell, so only a hit inside the cell is known to be the closest.
        isOn = !isDone(trace, anyHit) && trace.hit.t > next.t && isInLattice(next.cell, grid.resolution);
        left = isOn ? 1u : 0u;
        cell = next.cell;
    }
    finishUnless(left, trace);
}
