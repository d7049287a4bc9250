// SPDX-License-Identifier: MIT
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"

#include <array>
#include <bit>

namespace metamarch::bvh_wide {
namespace {

uvec4 childrenOf(const WideBvhNode& node) { return {node.child0, node.child1, node.child2, node.child3}; }

template <Invariants invariants>
[[gnu::flatten]] TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const std::vector<WideBvhNode>& nodes = structures.wideBvh();
    const std::vector<TriangleRecord>& triangles = structures.bvh().triangles;
    std::array<std::uint32_t, kMaxBvhDepth> stack; // wideRest
    std::size_t stackSize = 0;
    std::uint32_t child = 0;
    while (true) {
        while (!isBvhLeaf(child)) {
            ++trace.steps;
            const std::uint32_t nodeId = child;
            const WideBvhNode& node = nodes[nodeId];
            const WideHits hits =
                meetWideChildren(crossWideNode(ray, node.origin, node.steps, node.lo, node.hi), trace.hit.t);
            const std::uint32_t rest = hits.mask & ~(1u << hits.first);
            child = hits.mask == 0 ? kEmptyBvhLeaf : chooseWideChild(childrenOf(node), hits.first);
            if (rest != 0) {
                require<invariants>(stackSize < kMaxBvhDepth, "the wide BVH is deeper than the stack");
                stack[stackSize++] = wideRest(nodeId, rest);
            }
        }
        trace.steps += child == kEmptyBvhLeaf ? 0 : 1;
        testTriangles(triangles, ray, bvhFirstTriangle(child), bvhTriangleCount(child), trace);
        if (stackSize == 0 || isDone(trace, query)) {
            return trace;
        }
        const std::uint32_t top = stack[stackSize - 1];
        const std::uint32_t mask = wideRestMask(top);
        require<invariants>(mask != 0, "a node on the stack has no child left");
        child = chooseWideChild(childrenOf(nodes[wideRestNode(top)]),
                                static_cast<std::uint32_t>(std::countr_zero(mask)));
        const std::uint32_t rest = mask & (mask - 1);
        stack[stackSize - 1] = wideRest(wideRestNode(top), rest);
        stackSize -= rest == 0 ? 1 : 0;
    }
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace metamarch::bvh_wide
