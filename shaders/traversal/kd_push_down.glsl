// SPDX-License-Identifier: MIT
// Works like kd_restart, but restarts at the lowest node that contains the remaining ray.
//
// D. R. Horn, J. Sugerman, M. Houston, P. Hanrahan, "Interactive k-D Tree GPU Raytracing", I3D 2007: as long
// as a descent has met no plane that the remaining ray crosses, the node to restart at is pushed down with
// it.
//
// Why it ends: as in kd_restart, tNear grows from leaf to leaf through the distances of the tree's planes.
//
// Cost: for every leaf the path from the pushed-down node, 8 bytes per node; a 16-byte leaf and its triangles
// for each leaf. No memory per ray.
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
    uint restartId = 0u;
    float tNear = ray.tNear;

    // Invariant: every triangle that the ray meets before tNear has been tested, and the box of restartId
    // contains the ray from tNear to its end.
    while (true) {
        uint nodeId = restartId;
        float tFar = ray.tFar;
        bool pushDown = true;
        ++trace.steps;
        KdNode node = loadKdNode(nodeId);
        while (!isLeaf(node)) {
            const KdFork fork = forkAt(ray, nodeId, node, tNear, tFar);
            if (fork.meetsNear && fork.meetsFar) {
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
    }
}
