// SPDX-License-Identifier: MIT
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"

#include <array>

namespace metamarch::bvh_stack {
namespace {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const Bvh& bvh = structures.bvh();
    std::array<std::uint32_t, kMaxBvhDepth> stack;
    std::size_t stackSize = 0;
    std::uint32_t child = 0;
    while (true) {
        while (!isBvhLeaf(child)) {
            ++trace.steps;
            const BvhNode& node = bvh.nodes[child];
            const vec2 t0 = crossBox(ray, node.lo0, node.hi0, trace.hit.t);
            const vec2 t1 = crossBox(ray, node.lo1, node.hi1, trace.hit.t);
            const bool meets0 = t0.x <= t0.y;
            const bool meets1 = t1.x <= t1.y;
            const bool firstIs0 = meets0 && (!meets1 || t0.x <= t1.x);
            child = firstIs0 ? node.child0 : node.child1;
            if (meets0 && meets1) {
                require<invariants>(stackSize < kMaxBvhDepth, "the BVH is deeper than the stack");
                stack[stackSize++] = firstIs0 ? node.child1 : node.child0;
            }
            if (!meets0 && !meets1) {
                child = stackSize == 0 ? kEmptyBvhLeaf : stack[--stackSize];
            }
        }
        trace.steps += child == kEmptyBvhLeaf ? 0 : 1;
        testTriangles(bvh.triangles, ray, bvhFirstTriangle(child), bvhTriangleCount(child), trace);
        if (stackSize == 0 || isDone(trace, query)) {
            return trace;
        }
        child = stack[--stackSize];
    }
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace metamarch::bvh_stack
