// SPDX-License-Identifier: MIT
// Walks the kd-tree with a stack of four entries. When the stack is empty, it restarts like kd_push_down.
//
// D. R. Horn, J. Sugerman, M. Houston, P. Hanrahan, "Interactive k-D Tree GPU Raytracing", I3D 2007. The
// stack is in two vectors that swizzles shift, so it needs no memory. A push onto a full stack drops the
// oldest entry.
//
// Why it ends: both an entry and a restart begin at tFar, where the leaf before ended. So tNear grows from
// leaf to leaf through the finitely many distances of the tree's planes.
//
// Cost: an 8-byte node for each inner node and leaf visited, with those after restarts; a 16-byte leaf and
// its triangles for each leaf. The stack takes 32 bytes per ray, in registers.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#include "lib/kd_tree.glsl"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    uvec4 stackNodeId = uvec4(0u); // x is the top
    vec4 stackFar = vec4(0.0);
    uint stackSize = 0u;
    uint restartId = 0u;
    uint nodeId = 0u;
    bool pushDown = true;
    float tNear = ray.tNear;
    float tFar = ray.tFar;

    // Invariant: every triangle that the ray meets before tNear has been tested; the box of restartId
    // contains the ray from tNear to its end; the stack holds the nodes behind tFar, the nearest on top,
    // without those that were dropped from its other end.
    while (true) {
        ++trace.steps;
        KdNode node = loadKdNode(nodeId);
        while (!isLeaf(node)) {
            const KdFork fork = forkAt(ray, nodeId, node, tNear, tFar);
            if (fork.meetsNear && fork.meetsFar) {
                stackNodeId = uvec4(fork.farChild, stackNodeId.xyz);
                stackFar = vec4(tFar, stackFar.xyz);
                stackSize = min(stackSize + 1u, 4u);
                tFar = fork.tSplit;
                pushDown = false;
            }
            nodeId = fork.meetsNear ? fork.nearChild : fork.farChild;
            restartId = pushDown ? nodeId : restartId;
            ++trace.steps;
            node = loadKdNode(nodeId);
        }

        const Leaf leaf = enterLeaf(node, trace);
        testTriangles(ray, leaf.firstTriangle, leaf.triangleCount, trace);
        // A triangle may extend beyond its leaf, so only a hit inside the leaf is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= tFar || tFar >= ray.tFar) {
            finish(trace);
            return;
        }
        tNear = tFar;
        pushDown = stackSize == 0u;
        nodeId = pushDown ? restartId : stackNodeId.x;
        tFar = pushDown ? ray.tFar : stackFar.x;
        stackNodeId = stackNodeId.yzww;
        stackFar = stackFar.yzww;
        stackSize = pushDown ? 0u : stackSize - 1u;
    }
}
