// SPDX-License-Identifier: MIT
// The loop of the march through the meta table, with an observer.
#pragma once
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/shared/march.h"

namespace metamarch {

// One turn of the loop: the cell's leaf has been tested, and the ray has yet to leave its exit box.
struct MarchTurn {
    ivec3 cell;
    std::uint32_t leafId;
    const Leaf& leaf;
    const TraceResult& trace; // with this turn's tests
};

// Calls `observe` with each MarchTurn. An observer that does nothing costs nothing.
template <Invariants invariants, class Observer>
[[gnu::always_inline]] inline TraceResult marchMetaTable(const AccelerationStructure& scene, const Ray& ray,
                                                         const HitQuery query, Observer&& observe) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const uvec3 resolution = scene.lattice.resolution;
    const std::uint32_t mostSteps = resolution.x + resolution.y + resolution.z;
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    ivec3 cell = cellAt(ray, ray.tNear, ivec3(0), ivec3(resolution));
    while (true) {
        require<invariants>(isInLattice(cell, resolution), "the march left the lattice");
        require<invariants>(trace.steps < mostSteps, "the march did not end");
        ++trace.steps;
        const std::uint32_t leafId = scene.table.leafAt(cell);
        const Leaf& leaf = scene.table.leaves[leafId];
        testTriangles(scene.tableTriangles(), ray, leaf.firstTriangle, leaf.triangleCount, trace);
        observe(MarchTurn{cell, leafId, leaf, trace});
        if (isDone(trace, query)) {
            return trace;
        }
        const ivec3 lo = unpackCell(leaf.lo);
        const ivec3 hi = unpackCell(leaf.hi);
        require<invariants>(cell == clamp(cell, lo, hi - 1),
                            "the table names a leaf that does not hold the cell");
        const BoxExit next = leaveBox(ray, lo, hi, cell);
        require<invariants>(movedOn(cell, next.cell, upward), "the march did not move on");
        if (trace.hit.t <= next.t || !isInLattice(next.cell, resolution)) {
            return trace;
        }
        cell = next.cell;
    }
}

} // namespace metamarch
