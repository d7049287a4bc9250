// SPDX-License-Identifier: MIT
// Marches through a meta table over uneven cells: the cells between the planes of a kd-tree that are not on a
// lattice.
//
// This is a third kind of table, besides the two of Seo, Kang, Yang, "An Effective Ray Tracing Algorithm
// Using a Meta Table": the planes stay where the tree has put them, and buckets along each axis lead from a
// position to its cell. The march is that of traversal/meta_table.glsl, but cells are counted by planes.
//
// Why it ends: cellBehind moves the cell on by at least one on one axis and never back on the others, and the
// loop ends outside the lattice. So there are at most as many steps as the sum of the three resolutions,
// whatever the rounding errors. A search along an axis ends at the last plane.
//
// Cost per step: one or two table entries, one 16-byte leaf, three planes, and the leaf's triangles.
// The search for the next cell takes on each axis one bucket, one plane, and the planes between that and the
// position. No memory per ray.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#include "lib/rectilinear_table.glsl"
#include "shared/march.h"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    const uvec3 resolution = rectilinear.resolution;
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    ivec3 cell = clamp(searchCell(positionAt(ray, ray.tNear)), ivec3(0), ivec3(resolution) - 1);

    // Invariant: `cell` is in the lattice, and every triangle that the ray meets before it has been tested.
    bool isOn = true;
    uint left = 1u;
    while (isOn) {
        ++trace.steps;
        const Leaf leaf = loadLeaf(wordAt(cell, resolution));
        testTriangles(ray, leaf.firstTriangle, leaf.triangleCount, trace);
        const ivec3 lo = unpackCell(leaf.lo);
        const ivec3 hi = unpackCell(leaf.hi);
        const PlaneExit next = firstOf(ray, loadPlanes(mix(lo, hi, upward)));
        const ivec3 found = searchCell(positionAt(ray, next.t));
        cell = cellBehind(ray, lo, hi, cell, found, next.axis);
        // A triangle may extend beyond the box, so only a hit inside the box is known to be the closest.
        isOn = !isDone(trace, anyHit) && trace.hit.t > next.t && isInLattice(cell, resolution);
        left = isOn ? 1u : 0u;
    }
    finishUnless(left, trace);
}
