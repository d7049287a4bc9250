// SPDX-License-Identifier: MIT
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"
#include "metamarch/shared/march.h"

namespace metamarch::rectilinear_table {
namespace {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const RectilinearTable& scene = structures.rectilinearTable();
    const RectilinearPlanes& planes = scene.planes;
    const uvec3 resolution = planes.layout().resolution;
    const std::uint32_t mostSteps = resolution.x + resolution.y + resolution.z;
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    ivec3 cell = clamp(planes.searchCell(positionAt(ray, ray.tNear)), ivec3(0), ivec3(resolution) - 1);
    while (true) {
        require<invariants>(isInLattice(cell, resolution), "the march left the lattice");
        require<invariants>(trace.steps < mostSteps, "the march did not end");
        ++trace.steps;
        const Leaf& leaf = scene.table.leaves[scene.table.leafAt(cell)];
        testTriangles(scene.table.triangles, ray, leaf.firstTriangle, leaf.triangleCount, trace);
        const ivec3 lo = unpackCell(leaf.lo);
        const ivec3 hi = unpackCell(leaf.hi);
        require<invariants>(cell == clamp(cell, lo, hi - 1),
                            "the table names a leaf that does not hold the cell");
        const ivec3 farPlanes = mix(lo, hi, upward);
        const PlaneExit next = firstOf(ray, vec3(planes.plane(0, farPlanes.x), planes.plane(1, farPlanes.y),
                                                 planes.plane(2, farPlanes.z)));
        const ivec3 found = planes.searchCell(positionAt(ray, next.t));
        const ivec3 behind = cellBehind(ray, lo, hi, cell, found, next.axis);
        require<invariants>(movedOn(cell, behind, upward), "the march did not move on");
        if (isDone(trace, query) || trace.hit.t <= next.t || !isInLattice(behind, resolution)) {
            return trace;
        }
        cell = behind;
    }
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace metamarch::rectilinear_table
