// SPDX-License-Identifier: MIT
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"
#include "metamarch/shared/kd_walk.h"

#include <algorithm>
#include <array>

namespace metamarch::kd_short_stack {
namespace {

constexpr std::size_t kEntries = 4;

struct Pending {
    std::uint32_t nodeId;
    float tFar;
};

template <Invariants invariants>
[[gnu::flatten]] TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const AccelerationStructure& scene = structures.kdTree();
    std::array<Pending, kEntries> ring; // the newest at ring[newest]
    std::size_t newest = 0;
    std::size_t size = 0;
    std::uint32_t restartId = 0;
    std::uint32_t nodeId = 0;
    bool pushDown = true;
    float tNear = ray.tNear;
    float tFar = ray.tFar;
    while (true) {
        ++trace.steps;
        KdNode node = scene.tree.nodes[nodeId];
        while (!isLeaf(node)) {
            const KdFork fork = forkAt(ray, nodeId, node, tNear, tFar);
            if (fork.meetsNear && fork.meetsFar) {
                newest = (newest + 1) % kEntries;
                ring[newest] = {fork.farChild, tFar};
                size = std::min(size + 1, kEntries);
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
        pushDown = size == 0;
        if (pushDown) {
            nodeId = restartId;
            tFar = ray.tFar;
        } else {
            nodeId = ring[newest].nodeId;
            tFar = ring[newest].tFar;
            newest = (newest + kEntries - 1) % kEntries;
            --size;
        }
    }
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace metamarch::kd_short_stack
