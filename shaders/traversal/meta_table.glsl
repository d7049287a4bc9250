// SPDX-License-Identifier: MIT
// Marches the meta table: one look-up per leaf crossed, no stack, no tree.
//
// The ray's cell names its leaf; the leaf is tested; the ray leaves the leaf's exit box through one of the
// three far planes into the next cell. Seo, Kang, Yang, "An Effective Ray Tracing Algorithm Using a Meta
// Table"; integer stepping after Pérard-Gayot, Kalojanov, Slusallek, "GPU Ray Tracing using Irregular Grids",
// 2017.
//
// Why it ends: leaveBox moves the cell on by at least one in one axis and never back in the others, and the
// loop ends outside the lattice: at most the sum of the three resolutions in steps, whatever the floats.
//
// What it costs: per step one or, where leaves meet in a brick, two 4-byte table entries and one 16-byte
// leaf, plus the leaf's triangles. No memory per ray.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#include "lib/meta_table.glsl"
#include "shared/march.h"

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    BoxExit next = BoxExit(ray.tNear, cellAt(ray, ray.tNear, ivec3(0), ivec3(lattice.resolution)));

    // Holds here: next.cell lies in the lattice, and every triangle that the ray meets before it has been
    // tested.
    while (true) {
        // Most leaves on the way are empty. They have a loop of their own, for llvmpipe would run a triangle
        // test for each of them. The `if` is always true, and is needed there (Mesa 22.3.6): rays that have
        // left a loop go through it with the others, and only what is assigned under a condition stays as it
        // was.
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
        // A triangle may reach past the box: only a hit inside it is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= next.t || !isInLattice(next.cell, lattice.resolution)) {
            finish(trace);
            return;
        }
    }
}
