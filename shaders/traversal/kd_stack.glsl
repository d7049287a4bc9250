// SPDX-License-Identifier: MIT
// Walks the kd-tree front to back and keeps the far children on a stack.
//
// This is the classic traversal: M. Pharr, G. Humphreys, "Physically Based Rendering", 2004, section 4.4. It
// is the baseline of Seo, Kang, Yang, "An Effective Ray Tracing Algorithm Using a Meta Table" (figures 3 and
// 4).
//
// Why it ends: each turn goes one node down or pops one from the stack, and no node is pushed twice. A path
// has at most kMaxTreeDepth edges and leaves at most one pending child per edge, so the stack cannot
// overflow.
//
// Cost: an 8-byte node for each inner node and leaf visited, a 16-byte leaf and its triangles for each leaf.
// The stack takes kMaxTreeDepth * 8 bytes per ray, in private memory.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#include "lib/kd_tree.glsl"

struct Pending {
    uint nodeId;
    float tFar;
};

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    Pending stack[kMaxTreeDepth];
    uint stackSize = 0u;
    uint nodeId = 0u;
    float tNear = ray.tNear;
    float tFar = ray.tFar;

    // Invariant: every triangle that the ray meets before tNear has been tested; the stack holds the nodes
    // behind tFar, the nearest on top.
    while (true) {
        ++trace.steps;
        KdNode node = loadKdNode(nodeId);
        while (!isLeaf(node)) {
            const KdFork fork = forkAt(ray, nodeId, node, tNear, tFar);
            if (fork.meetsNear && fork.meetsFar) {
                stack[stackSize] = Pending(fork.farChild, tFar);
                ++stackSize;
                tFar = fork.tSplit;
            }
            nodeId = fork.meetsNear ? fork.nearChild : fork.farChild;
            ++trace.steps;
            node = loadKdNode(nodeId);
        }

        const Leaf leaf = enterLeaf(node, trace);
        testTriangles(ray, leaf.firstTriangle, leaf.triangleCount, trace);
        // A triangle may extend beyond its leaf, so only a hit inside the leaf is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= tFar || stackSize == 0u) {
            finish(trace);
            return;
        }
        // The node on top begins where the leaf ended.
        --stackSize;
        nodeId = stack[stackSize].nodeId;
        tNear = tFar;
        tFar = stack[stackSize].tFar;
    }
}
