// SPDX-License-Identifier: MIT
// Walks a bounding volume hierarchy, the nearer child first, and keeps the farther ones on a stack.
//
// A node contains the boxes of both children, so that one visit tests two boxes, and a ray that meets neither
// takes the next node from the stack at once: T. Aila, S. Laine, "Understanding the Efficiency of Ray
// Traversal on GPUs", HPG 2009. The builder splits by binned SAH (accel/bvh.h).
//
// Why it ends: each turn goes one node down or pops one from the stack, and no node is pushed twice. A path
// has at most kMaxBvhDepth edges and leaves at most one pending child per edge, so the stack cannot overflow.
//
// Cost: 64 bytes for each inner node visited, and the triangles of each leaf. Leaves have no record of their
// own. The stack takes kMaxBvhDepth * 4 bytes per ray, in private memory. It does not hold the t of a box:
// on llvmpipe a store to private memory costs more than a visit that a kept t would save.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter. So a box that begins exactly at the best t is still opened.

#include "lib/bvh.glsl"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    uint stack[kMaxBvhDepth];
    uint stackSize = 0u;
    uint child = 0u;
    uint left = 1u; // not 0 while there is work left to do

    // llvmpipe leaves a loop only at its end, so each loop asks there and does its work under a condition.
    //
    // Invariant: every untested triangle in a box that the ray meets is below `child` or on the stack.
    bool isOn = true;
    do {
        if (isOn) {
            bool isDescending = !isBvhLeaf(child);
            do {
                if (isDescending) {
                    ++trace.steps;
                    const BvhNode node = loadBvhNode(child);
                    const vec2 t0 = crossBox(ray, node.lo0, node.hi0, trace.hit.t);
                    const vec2 t1 = crossBox(ray, node.lo1, node.hi1, trace.hit.t);
                    const bool meets0 = t0.x <= t0.y;
                    const bool meets1 = t1.x <= t1.y;
                    const bool firstIs0 = meets0 && (!meets1 || t0.x <= t1.x);
                    child = firstIs0 ? node.child0 : node.child1;
                    if (meets0 && meets1) {
                        stack[stackSize] = firstIs0 ? node.child1 : node.child0;
                        ++stackSize;
                    }
                    if (!meets0 && !meets1) {
                        const bool hasPending = stackSize != 0u;
                        stackSize -= hasPending ? 1u : 0u;
                        child = hasPending ? stack[stackSize] : kEmptyBvhLeaf;
                    }
                    isDescending = !isBvhLeaf(child);
                }
            } while (isDescending);
            left = isBvhLeaf(child) ? 0u : 1u; // 1 if the driver ended the way down
            trace.steps += child == kEmptyBvhLeaf ? 0u : 1u;
            testTriangles(ray, bvhFirstTriangle(child), bvhTriangleCount(child), trace);
            isOn = stackSize != 0u && !isDone(trace, anyHit);
            stackSize -= isOn ? 1u : 0u;
            child = isOn ? stack[stackSize] : kEmptyBvhLeaf;
            left |= isOn ? 1u : 0u;
        }
    } while (isOn);
    finishUnless(left, trace);
}
