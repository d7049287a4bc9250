// SPDX-License-Identifier: MIT
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"
#include "metamarch/shared/grid_walk.h"

namespace metamarch::uniform_grid {
namespace {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const UniformGrid& grid = structures.uniformGrid();
    const Ray gridRay = inGrid(grid.grid, ray);
    const uvec3 resolution = grid.grid.resolution;
    const std::uint32_t mostSteps = resolution.x + resolution.y + resolution.z;
    ivec3 cell = cellAt(gridRay, ray.tNear, ivec3(0), ivec3(resolution));
    while (true) {
        require<invariants>(trace.steps < mostSteps, "the walk did not end");
        ++trace.steps;
        const GridCell& content = grid.cells[cellIndex(cell, resolution)];
        testTriangles(grid.triangles, ray, content.firstTriangle, content.triangleCount, trace);
        const BoxExit next = leaveCell(gridRay, cell);
        if (isDone(trace, query) || trace.hit.t <= next.t || !isInLattice(next.cell, resolution)) {
            return trace;
        }
        cell = next.cell;
    }
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace metamarch::uniform_grid
