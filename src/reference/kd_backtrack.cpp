// SPDX-License-Identifier: MIT
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"
#include "metamarch/shared/kd_walk.h"

#include <algorithm>

namespace metamarch::kd_backtrack {
namespace {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const AccelerationStructure& scene = structures.kdTree();
    const std::span<const KdParent> parents = structures.kdParents();
    std::uint32_t nodeId = 0;
    float tNear = ray.tNear;
    float tFar = ray.tFar;
    while (true) {
        ++trace.steps;
        KdNode node = scene.tree.nodes[nodeId];
        while (!isLeaf(node)) {
            const KdFork fork = forkAt(ray, nodeId, node, tNear, tFar);
            if (fork.meetsNear && fork.meetsFar) {
                tFar = fork.tSplit;
            }
            nodeId = fork.meetsNear ? fork.nearChild : fork.farChild;
            ++trace.steps;
            node = scene.tree.nodes[nodeId];
        }
        require<invariants>(tFar > tNear || tFar >= ray.tFar, "the walk did not move on");
        const Leaf& leaf = scene.tree.leaves[leafOf(node)];
        testTriangles(scene.triangles, ray, leaf.firstTriangle, leaf.triangleCount, trace);
        if (isDone(trace, query) || trace.hit.t <= tFar || tFar >= ray.tFar) {
            return trace;
        }
        tNear = tFar;
        do {
            if (nodeId == 0) {
                return trace;
            }
            nodeId = parents[nodeId].parent;
            ++trace.steps;
        } while (exitOf(ray, parents[nodeId]) <= tNear);
        tFar = std::min(exitOf(ray, parents[nodeId]), ray.tFar);
    }
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace metamarch::kd_backtrack
