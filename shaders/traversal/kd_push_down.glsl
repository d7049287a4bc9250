// SPDX-License-Identifier: MIT
// kd_restart that starts again no higher than it must: at the lowest node that holds the rest of the ray.
//
// D. R. Horn, J. Sugerman, M. Houston, P. Hanrahan, "Interactive k-D Tree GPU Raytracing", I3D 2007: while a
// descent has met no plane that the rest of the ray crosses, the node to restart at is pushed down with it.
//
// Why it ends: as kd_restart; tNear grows from leaf to leaf through the distances of the tree's planes.
//
// What it costs: the path from the pushed-down node for every leaf, 8 bytes a node; a 16-byte leaf and its
// triangles for each leaf. No memory per ray.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#include "lib/kd_tree.glsl"

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    uint restartId = 0u;
    float tNear = ray.tNear;

    // Holds here: every triangle that the ray meets before tNear has been tested, and the box of restartId
    // holds the ray from tNear to its end.
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
        // A triangle may reach past its leaf: only a hit inside it is known to be the closest.
        if (isDone(trace, anyHit) || trace.hit.t <= tFar || tFar >= ray.tFar) {
            finish(trace);
            return;
        }
        tNear = tFar;
    }
}
