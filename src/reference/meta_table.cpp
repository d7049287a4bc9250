#include "reference/require.h"
#include "reference/triangle_records.h"
#include "shared/march.h"

namespace metamarch {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traceMetaTable(const AccelerationStructure& scene, const Ray& ray,
                                            const HitQuery query) {
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
        const Leaf& leaf = scene.table.leaves[scene.table.leafAt(cell)];
        testTriangles(scene.tableTriangles(), ray, leaf.firstTriangle, leaf.triangleCount, trace);
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

template TraceResult traceMetaTable<Invariants::checked>(const AccelerationStructure&, const Ray&, HitQuery);
template TraceResult traceMetaTable<Invariants::unchecked>(const AccelerationStructure&, const Ray&,
                                                           HitQuery);

} // namespace metamarch
