// SPDX-License-Identifier: MIT
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"
#include "metamarch/shared/kd_walk.h"

namespace metamarch::kd_push_down {
namespace {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const AccelerationStructure& scene = structures.kdTree();
    std::uint32_t restartId = 0;
    float tNear = ray.tNear;
    while (true) {
        std::uint32_t nodeId = restartId;
        float tFar = ray.tFar;
        bool pushDown = true;
        ++trace.steps;
        KdNode node = scene.tree.nodes[nodeId];
        while (!isLeaf(node)) {
            const KdFork fork = forkAt(ray, nodeId, node, tNear, tFar);
            if (fork.meetsNear && fork.meetsFar) {
                tFar = fork.tSplit;
                pushDown = false;
            }
            nodeId = fork.meetsNear ? fork.nearChild : fork.farChild;
            restartId = pushDown ? nodeId : restartId;
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
    }
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace metamarch::kd_push_down
