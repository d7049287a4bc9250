// SPDX-License-Identifier: MIT
// Walks a wide bounding volume hierarchy: nodes of four children, whose boxes take a byte a plane. The
// nearest child comes first; the others are one word on the stack.
//
// After H. Ylitie, T. Karras, S. Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
// BVHs", HPG 2017. There nodes have eight children, and the order of children comes from the ray's octant.
//
// Why it ends: each turn goes one node down or takes one child from the stack, and no child is taken twice. A
// path has at most kMaxBvhDepth edges and leaves at most one word per edge, so the stack cannot overflow.
//
// Cost: 64 bytes for each inner node visited, 16 more for each child from the stack, and the triangles of
// each leaf. The stack takes kMaxBvhDepth * 4 bytes per ray, in private memory.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter. So a box that begins exactly at the best t is still opened.

#include "lib/wide_bvh.glsl"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    uint stack[kMaxBvhDepth]; // wideRest
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
                    const uint nodeId = child;
                    const WideHits hits = meetWideChildren(crossWideNodeOf(ray, nodeId), trace.hit.t);
                    const uint rest = hits.mask & ~(1u << hits.first);
                    child = hits.mask == 0u ? kEmptyBvhLeaf
                                            : chooseWideChild(loadWideChildren(nodeId), hits.first);
                    if (rest != 0u) {
                        stack[stackSize] = wideRest(nodeId, rest);
                        ++stackSize;
                    }
                    isDescending = !isBvhLeaf(child);
                }
            } while (isDescending);
            left = isBvhLeaf(child) ? 0u : 1u; // 1 if the driver ended the way down
            trace.steps += child == kEmptyBvhLeaf ? 0u : 1u;
            testTriangles(ray, bvhFirstTriangle(child), bvhTriangleCount(child), trace);
            isOn = stackSize != 0u && !isDone(trace, anyHit);
            if (isOn) {
                const uint top = stack[stackSize - 1u];
                const uint mask = wideRestMask(top);
                child = chooseWideChild(loadWideChildren(wideRestNode(top)), uint(findLSB(mask)));
                const uint rest = mask & (mask - 1u);
                stack[stackSize - 1u] = wideRest(wideRestNode(top), rest);
                stackSize -= rest == 0u ? 1u : 0u;
            }
            left |= isOn ? 1u : 0u;
        }
    } while (isOn);
    finishUnless(left, trace);
}
