// SPDX-License-Identifier: MIT
// Walks the kd-tree without a stack: after each leaf it restarts at the root, further along the ray.
//
// T. Foley, J. Sugerman, "KD-Tree Acceleration Structures for a GPU Raytracer", Graphics Hardware 2005.
//
// Why it ends: a descent ends in a leaf at tFar > tNear, because a plane at tSplit <= tNear sends it to the
// far child. So tNear grows from leaf to leaf through the finitely many distances of the tree's planes.
//
// Cost: for every leaf the whole path from the root, 8 bytes per node; a 16-byte leaf and its triangles for
// each leaf. No memory per ray.
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
    float tNear = ray.tNear;

    // Invariant: every triangle that the ray meets before tNear has been tested.
    bool isOn = true;
    uint left = 1u;
    while (isOn) {
        uint nodeId = 0u;
        float tFar = ray.tFar;
        ++trace.steps;
        KdNode node = loadKdNode(nodeId);
        while (!isLeaf(node)) {
            const KdFork fork = forkAt(ray, nodeId, node, tNear, tFar);
            tFar = fork.meetsNear && fork.meetsFar ? fork.tSplit : tFar;
            nodeId = fork.meetsNear ? fork.nearChild : fork.farChild;
            ++trace.steps;
            node = loadKdNode(nodeId);
        }

        const Leaf leaf = enterLeaf(node, trace);
        testTriangles(ray, leaf.firstTriangle, leaf.triangleCount, trace);
        // A triangle may extend beyond its leaf, so only a hit inside the leaf is known to be the closest.
        isOn = !isDone(trace, anyHit) && trace.hit.t > tFar && tFar < ray.tFar;
        left = isOn ? 1u : 0u;
        tNear = tFar;
    }
    finishUnless(left, trace);
}
