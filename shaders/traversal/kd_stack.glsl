// SPDX-License-Identifier: MIT
// Walks the kd-tree front to back and keeps the far children for later on a stack.
//
// The classic: M. Pharr, G. Humphreys, "Physically Based Rendering", 2004, section 4.4; figures 3 and 4 of
// Seo, Kang, Yang, "An Effective Ray Tracing Algorithm Using a Meta Table", whose baseline it is.
//
// Why it ends: each turn goes one node down or takes one off the stack, and no node is put there twice. A
// path has at most kMaxTreeDepth edges and leaves at most one pending child per edge: the stack cannot
// overflow.
//
// What it costs: an 8-byte node for each inner node and leaf visited, a 16-byte leaf and its triangles for
// each leaf. A stack of kMaxTreeDepth * 8 bytes per ray, in private memory.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#include "lib/kd_tree.glsl"

struct Pending {
    uint nodeId;
    float tFar;
};

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
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

    // Holds here: every triangle that the ray meets before tNear has been tested; the stack holds what lies
    // behind tFar, nearest on top.
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
        // A triangle may reach past its leaf: only a hit inside it is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= tFar || stackSize == 0u) {
            finish(trace);
            return;
        }
        // The top begins where the leaf ended.
        --stackSize;
        nodeId = stack[stackSize].nodeId;
        tNear = tFar;
        tFar = stack[stackSize].tFar;
    }
}
