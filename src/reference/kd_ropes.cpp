// SPDX-License-Identifier: MIT
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"
#include "metamarch/shared/kd_rope.h"

namespace metamarch::kd_ropes {
namespace {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const AccelerationStructure& scene = structures.kdTree();
    const std::span<const std::uint32_t> ropes = structures.kdRopes();
    ivec3 cell = cellAt(ray, ray.tNear, ivec3(0), ivec3(scene.lattice.resolution));
    std::uint32_t nodeId = 0;
    while (true) {
        ++trace.steps;
        KdNode node = scene.tree.nodes[nodeId];
        while (!isLeaf(node)) {
            nodeId = childWithCell(nodeId, node, cell);
            ++trace.steps;
            node = scene.tree.nodes[nodeId];
        }
        const Leaf& leaf = scene.tree.leaves[leafOf(node)];
        const ivec3 lo = unpackCell(leaf.lo);
        const ivec3 hi = unpackCell(leaf.hi);
        require<invariants>(cell == clamp(cell, lo, hi - 1),
                            "the rope leads to a leaf that does not hold the cell");
        testTriangles(scene.triangles, ray, leaf.firstTriangle, leaf.triangleCount, trace);
        const BoxExit next = leaveBox(ray, lo, hi, cell);
        if (isDone(trace, query) || trace.hit.t <= next.t) {
            return trace;
        }
        nodeId = ropes[ropeTowards(leafOf(node), next.cell, lo, hi)];
        require<invariants>((nodeId == kNoRope) == !isInLattice(next.cell, scene.lattice.resolution),
                            "the ropes do not end at the faces of the lattice");
        if (nodeId == kNoRope) {
            return trace;
        }
        cell = next.cell;
    }
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace metamarch::kd_ropes
