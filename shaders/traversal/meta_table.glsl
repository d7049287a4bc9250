// SPDX-License-Identifier: MIT
// Marches through the meta table: one look-up per leaf crossed, no stack, no tree.
//
// The table gives the leaf of the ray's cell. The leaf's triangles are tested. Then the ray leaves the leaf's
// exit box through one of the three far planes and enters the next cell. Seo, Kang, Yang, "An Effective Ray
// Tracing Algorithm Using a Meta Table"; the integer steps follow Pérard-Gayot, Kalojanov, Slusallek, "GPU
// Ray Tracing using Irregular Grids", 2017.
//
// Why it ends: leaveBox moves the cell on by at least one on one axis and never back on the others, and the
// loop ends outside the lattice. So there are at most as many steps as the sum of the three resolutions,
// whatever the rounding errors.
//
// Cost per step: one 4-byte table entry, or two where leaves meet in a brick, one 16-byte leaf, and the
// leaf's triangles. No memory per ray.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#include "lib/meta_table.glsl"
#include "shared/march.h"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    BoxExit next = BoxExit(ray.tNear, cellAt(ray, ray.tNear, ivec3(0), ivec3(lattice.resolution)));

    // Invariant: next.cell is in the lattice, and every triangle that the ray meets before it has been
    // tested.
    while (true) {
        // Most leaves on the way are empty. They have a loop of their own, because llvmpipe would execute a
        // triangle test for each of them. The `if` is always true but needed (Mesa 22.3.6): llvmpipe executes
        // the loop again for rays that have left it, and only assignments under a condition do not change
        // them.
        Leaf leaf = Leaf(0u, 0u, 0u, 0u);
        do {
            if (leaf.triangleCount == 0u) {
                ++trace.steps;
                leaf = loadLeafAt(next.cell, lattice.resolution);
                next = leaveBox(ray, unpackCell(leaf.lo), unpackCell(leaf.hi), next.cell);
            }
        } while (leaf.triangleCount == 0u && next.t < trace.hit.t &&
                 isInLattice(next.cell, lattice.resolution));

        testTriangles(ray, leaf.firstTriangle, leaf.triangleCount, trace);
        // A triangle may extend beyond the box, so only a hit inside the box is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= next.t || !isInLattice(next.cell, lattice.resolution)) {
            finish(trace);
            return;
        }
    }
}
