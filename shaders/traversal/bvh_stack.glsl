// SPDX-License-Identifier: MIT
// Walks a bounding volume hierarchy, the nearer child first, and keeps the farther ones on a stack.
//
// A node contains the boxes of both children, so that one visit tests two boxes: T. Aila, S. Laine,
// "Understanding the Efficiency of Ray Traversal on GPUs", HPG 2009. The builder splits by binned SAH
// (accel/bvh.h).
//
// Why it ends: each turn goes one node down or pops one from the stack, and no node is pushed twice. A path
// has at most kMaxBvhDepth edges and leaves at most one pending child per edge, so the stack cannot overflow.
//
// Cost: 64 bytes for each inner node visited, and the triangles of each leaf. Leaves have no record of their
// own. The stack takes kMaxBvhDepth * 8 bytes per ray, in private memory.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter. So a box that begins exactly at the best t is still opened.

#include "lib/bvh.glsl"

struct Pending {
    uint child;
    float tNear;
};

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    Pending stack[kMaxBvhDepth];
    uint stackSize = 0u;
    uint child = 0u;

    // Invariant: every untested triangle in a box that the ray meets is below `child` or on the stack.
    while (true) {
        bool missed = false;
        while (!missed && !isBvhLeaf(child)) {
            ++trace.steps;
            const BvhNode node = loadBvhNode(child);
            const vec2 t0 = crossBox(ray, node.lo0, node.hi0, trace.hit.t);
            const vec2 t1 = crossBox(ray, node.lo1, node.hi1, trace.hit.t);
            const bool meets0 = t0.x <= t0.y;
            const bool meets1 = t1.x <= t1.y;
            const bool firstIs0 = meets0 && (!meets1 || t0.x <= t1.x);
            if (meets0 && meets1) {
                stack[stackSize] = Pending(firstIs0 ? node.child1 : node.child0, max(t0.x, t1.x));
                ++stackSize;
            }
            missed = !meets0 && !meets1;
            child = firstIs0 ? node.child0 : node.child1;
        }
        if (!missed) {
            ++trace.steps;
            trace.expectedTests +=
                isBvhLeaf(child) ? 0u : 1u; // not finished if the driver ended the way down
            testTriangles(ray, bvhFirstTriangle(child), bvhTriangleCount(child), trace);
            if (isDone(trace, anyHit)) {
                finish(trace);
                return;
            }
        }
        // Pop the next node whose box begins before the best hit.
        float tNear;
        do {
            if (stackSize == 0u) {
                finish(trace);
                return;
            }
            --stackSize;
            child = stack[stackSize].child;
            tNear = stack[stackSize].tNear;
        } while (tNear > trace.hit.t);
    }
}
