// SPDX-License-Identifier: MIT
// Walks the kd-tree without a stack: after each leaf it climbs to the first ancestor that the ray has not
// left yet.
//
// T. Foley, J. Sugerman, "KD-Tree Acceleration Structures for a GPU Raytracer", Graphics Hardware 2005. Each
// node knows its parent and its box. The ray's exit from the box has the same bits as tSplit of the same
// plane.
//
// Why it ends: the climb ends at a box that the ray leaves later than tNear, or past the root. The descent
// ends in a leaf at tFar > tNear, because a plane at tSplit <= tNear sends it to the far child. So tNear
// grows from leaf to leaf through the finitely many distances of the tree's planes.
//
// Cost: an 8-byte node for each inner node and leaf on the way down, a 16-byte parent record for each on the
// way up, and a 16-byte leaf and its triangles for each leaf. No memory per ray. Steps count both ways.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#include "lib/kd_parents.glsl"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    uint nodeId = 0u;
    float tNear = ray.tNear;
    float tFar = ray.tFar;

    // Invariant: every triangle that the ray meets before tNear has been tested; the ray is in the box of
    // nodeId from tNear to tFar.
    while (true) {
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
        if (isDone(trace, anyHit) || trace.hit.t <= tFar || tFar >= ray.tFar) {
            finish(trace);
            return;
        }
        tNear = tFar;
        KdParent record = loadKdParent(nodeId);
        do {
            if (nodeId == 0u) {
                finish(trace);
                return;
            }
            nodeId = record.parent;
            ++trace.steps;
            record = loadKdParent(nodeId);
        } while (exitOf(ray, record) <= tNear);
        tFar = min(exitOf(ray, record), ray.tFar);
    }
}
