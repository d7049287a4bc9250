// SPDX-License-Identifier: MIT
// Marches a meta table over uneven cells: those between the planes of a kd-tree that lie on no lattice.
//
// The third way to a table, beside the two methods of Seo, Kang, Yang, "An Effective Ray Tracing Algorithm
// Using a Meta Table": the planes stay where the tree wants them, and a fine look-up along each axis leads
// from a position to the cell. The march is that of traversal/meta_table.glsl, its steps are in numbers of
// planes.
//
// Why it ends: cellBehind moves the cell on by at least one in one axis and never back in the others, and the
// loop ends outside the lattice: at most the sum of the three resolutions in steps, whatever the floats. A
// search along an axis ends at the last plane.
//
// What it costs: per step one or two 4-byte table entries, one 16-byte leaf and three planes, and for the
// cell behind three look-ups, each with one plane and those between it and the position; plus the leaf's
// triangles. No memory per ray.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#include "lib/rectilinear_table.glsl"
#include "shared/march.h"

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    const uvec3 resolution = rectilinear.resolution;
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    ivec3 cell = clamp(searchCell(positionAt(ray, ray.tNear)), ivec3(0), ivec3(resolution) - 1);

    // Holds here: cell lies in the lattice, and every triangle that the ray meets before it has been tested.
    while (true) {
        ++trace.steps;
        const Leaf leaf = loadLeafAt(cell, resolution);
        testTriangles(ray, leaf.firstTriangle, leaf.triangleCount, trace);
        const ivec3 lo = unpackCell(leaf.lo);
        const ivec3 hi = unpackCell(leaf.hi);
        const PlaneExit next = firstOf(ray, loadPlanes(mix(lo, hi, upward)));
        const ivec3 found = searchCell(positionAt(ray, next.t));
        cell = cellBehind(ray, lo, hi, cell, found, next.axis);
        // A triangle may reach past the box: only a hit inside it is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= next.t || !isInLattice(cell, resolution)) {
            finish(trace);
            return;
        }
    }
}
