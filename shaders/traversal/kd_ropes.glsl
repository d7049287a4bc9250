// SPDX-License-Identifier: MIT
// Follows ropes from leaf to leaf of the kd-tree: each face of a leaf names the smallest node behind it.
//
// S. Popov, J. Guenther, H.-P. Seidel, P. Slusallek, "Stackless KD-Tree Traversal for High Performance GPU
// Ray Tracing", Eurographics 2007; ropes after V. Havran, J. Bittner, J. Zara, "Ray Tracing with Rope Trees",
// SCCG 1998. The way out of a leaf and the cell behind it are those of the march (leaveBox), and the walk
// down from the rope's node compares integers.
//
// Why it ends: leaveBox moves the cell on by at least one in one axis and never back in the others, and a
// walk down ends with the tree.
//
// What it costs: one 4-byte rope per leaf after the first, 8 bytes for each inner node and leaf below it, a
// 16-byte leaf and its triangles. No memory per ray; six ropes per leaf.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#include "lib/kd_ropes.glsl"

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    ivec3 cell = cellAt(ray, ray.tNear, ivec3(0), ivec3(lattice.resolution));
    uint nodeId = 0u;

    // Holds here: the box of nodeId holds cell, and every triangle that the ray meets before cell has been
    // tested.
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
        // A triangle may reach past its leaf: only a hit inside it is known to be the closest.
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
