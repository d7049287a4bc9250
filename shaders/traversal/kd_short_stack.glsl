// SPDX-License-Identifier: MIT
// Walks the kd-tree with a stack of four entries and restarts, pushed down, when it has lost one.
//
// D. R. Horn, J. Sugerman, M. Houston, P. Hanrahan, "Interactive k-D Tree GPU Raytracing", I3D 2007. The
// stack lives in two vectors and moves by swizzles, so no memory is addressed: pushing onto a full one drops
// the oldest entry.
//
// Why it ends: an entry begins at tFar, where the leaf before it ended, and a restart does too; so tNear
// grows from leaf to leaf through the finitely many distances of the tree's planes.
//
// What it costs: an 8-byte node for each inner node and leaf visited, restarts included; a 16-byte leaf and
// its triangles for each leaf. 32 bytes of stack per ray, in registers.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#include "lib/kd_tree.glsl"

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    uvec4 stackNodeId = uvec4(0u); // the top in x
    vec4 stackFar = vec4(0.0);
    uint stackSize = 0u;
    uint restartId = 0u;
    uint nodeId = 0u;
    bool pushDown = true;
    float tNear = ray.tNear;
    float tFar = ray.tFar;

    // Holds here: every triangle that the ray meets before tNear has been tested; the box of restartId holds
    // the ray from tNear to its end; the stack holds what lies behind tFar, nearest on top, but for entries
    // that were dropped from its other end.
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
        // A triangle may reach past its leaf: only a hit inside it is known to be the closest.
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
