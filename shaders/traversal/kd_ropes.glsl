// SPDX-License-Identifier: MIT
// Follows ropes from leaf to leaf of the kd-tree: each face of a leaf names the smallest node behind it.
//
// S. Popov, J. Guenther, H.-P. Seidel, P. Slusallek, "Stackless KD-Tree Traversal for High Performance GPU
// Ray Tracing", Eurographics 2007; ropes after V. Havran, J. Bittner, J. Zara, "Ray Tracing with Rope Trees",
// SCCG 1998. As in the march, leaveBox finds the exit of a leaf and the cell behind it. The walk down from
// the rope's node compares integers.
//
// Why it ends: leaveBox moves the cell on by at least one on one axis and never back on the others, and a
// walk down ends at a leaf.
//
// Cost: one 4-byte rope per leaf after the first, 8 bytes for each inner node and leaf below the rope's node,
// a 16-byte leaf and its triangles. No memory per ray. The structure has six ropes per leaf.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#include "lib/kd_ropes.glsl"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    ivec3 cell = cellAt(ray, ray.tNear, ivec3(0), ivec3(lattice.resolution));
    uint nodeId = 0u;

    // Invariant: the box of nodeId contains `cell`, and every triangle that the ray meets before `cell` has
    // been tested.
    while (true) {
        ++trace.steps;
        KdNode node = loadKdNode(nodeId);
        while (!isLeaf(node)) {
            nodeId = childWithCell(nodeId, node, cell);
            ++trace.steps;
            node = loadKdNode(nodeId);
        }

        const uint leafId = leafOf(node);
        const Leaf leaf = enterLeaf(node, trace);
        testTriangles(ray, leaf.firstTriangle, leaf.triangleCount, trace);
        const ivec3 lo = unpackCell(leaf.lo);
        const ivec3 hi = unpackCell(leaf.hi);
        const BoxExit next = leaveBox(ray, lo, hi, cell);
        // A triangle may extend beyond its leaf, so only a hit inside the leaf is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= next.t) {
            finish(trace);
            return;
        }
        nodeId = LOAD1(kdRopes, ropeTowards(leafId, next.cell, lo, hi));
        if (nodeId == kNoRope) {
            finish(trace);
            return;
        }
        cell = next.cell;
    }
}
