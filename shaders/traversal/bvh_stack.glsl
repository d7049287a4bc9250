// SPDX-License-Identifier: MIT
// Walks a bounding volume hierarchy, the nearer child first, and keeps the farther ones on a stack.
//
// A node holds the boxes of both children, so that one visit decides on two: T. Aila, S. Laine,
// "Understanding the Efficiency of Ray Traversal on GPUs", HPG 2009. The builder splits by binned SAH
// (accel/bvh.h).
//
// Why it ends: each turn goes one node down or takes one off the stack, and no node is put there twice. A
// path has at most kMaxBvhDepth edges and leaves at most one pending child per edge: the stack cannot
// overflow.
//
// What it costs: 64 bytes for each inner node visited, and the triangles of each leaf; leaves have no record
// of their own. A stack of kMaxBvhDepth * 8 bytes per ray, in private memory.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.
// So a box that begins exactly at the best t is still opened.

#include "lib/bvh.glsl"

struct Pending {
    uint child;
    float tNear;
};

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    Pending stack[kMaxBvhDepth];
    uint stackSize = 0u;
    uint child = 0u;

    // Holds here: every triangle in a box that the ray meets, not yet tested, is below child or on the stack.
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
                isBvhLeaf(child) ? 0u : 1u; // not finished, where the way down was cut short
            testTriangles(ray, bvhFirstTriangle(child), bvhTriangleCount(child), trace);
            if (isDone(trace, anyHit)) {
                finish(trace);
                return;
            }
        }
        // Take the next one whose box begins before the best hit.
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
