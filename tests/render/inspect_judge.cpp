// SPDX-License-Identifier: MIT
#include "render/inspect_judge.h"

#include "metamarch/reference/twins.h"
#include "metamarch/render/view_names.h"
#include "metamarch/shared/cells.h"
#include "metamarch/shared/inspect.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace metamarch::tests {
namespace {

// Finds triangles by their id, because the records of the twins are in different orders.
const TriangleRecord& recordOf(const StructureSet& scene, const std::uint32_t triangleId) {
    const std::vector<TriangleRecord>& all = scene.triangles();
    const auto found = std::ranges::lower_bound(all, triangleId, {}, &TriangleRecord::triangleId);
    if (found == all.end() || found->triangleId != triangleId) {
        throw std::logic_error("the hit triangle has no record");
    }
    return *found;
}

std::uint32_t leafBeside(const AccelerationStructure& scene, const ivec3 cell) {
    return isInLattice(cell, scene.lattice.resolution) ? scene.table.leafAt(cell) : kNoLeaf;
}

CellFacts cellFacts(const AccelerationStructure& scene, const CellPlace& place) {
    const std::uint32_t leafId = scene.table.leafAt(place.cell);
    return {place, leafId,
            uvec3(leafBeside(scene, place.cell + ivec3(place.side.x, 0, 0)),
                  leafBeside(scene, place.cell + ivec3(0, place.side.y, 0)),
                  leafBeside(scene, place.cell + ivec3(0, 0, place.side.z))),
            scene.table.leaves[leafId].lo, scene.table.leaves[leafId].hi};
}

} // namespace

std::vector<std::uint32_t> inspectOnCpu(const StructureSet& scene, const ShadingScene& shading,
                                        const std::string& traversal, const Camera& camera,
                                        const std::uint32_t view, const float scaleMax,
                                        const float scaleMin) {
    const render::ViewReads reads = render::kViewNames.at(view).reads;
    const bool isCells = reads == render::ViewReads::cells;
    const TwinLoop& twin = findTwin(isCells ? "meta_table" : traversal);
    const Lattice& lattice = scene.kdTree().lattice;
    const InspectPush push{0, {}, view, scaleMax, scaleMin};
    std::vector<std::uint32_t> picture(std::size_t{camera.width} * camera.height);
    tbb::parallel_for(0u, camera.height, [&](const uint y) {
        for (uint x = 0; x < camera.width; ++x) {
            const CameraRay seen = centerRay(camera, x, y);
            const Ray ray = makeRay(lattice, seen.origin, 0.0f, seen.dir, kFarthest);
            const TraceResult trace = twin.checked(scene, ray, HitQuery::closest);
            const Inspected found{seen, ray, trace.hit, trace.steps, trace.tests};
            const bool isHit = trace.hit.triangleId != kNoTriangle;
            const TriangleRecord triangle = isHit ? recordOf(scene, trace.hit.triangleId) : TriangleRecord();
            std::uint32_t& pixel = picture[std::size_t{y} * camera.width + x];
            if (isCells) {
                const CellFacts facts =
                    isHit ? cellFacts(scene.kdTree(), cellPlace(ray, trace.hit.t, lattice.resolution))
                          : noCellFacts();
                pixel = cellsPixel(push, camera, uvec2(x, y), lattice, found, triangle, facts);
            } else if (reads == render::ViewReads::parameters) {
                pixel = parameterPixel(shading, push, found, triangle);
            } else {
                pixel = inspectedPixel(shading, push, camera, found, triangle);
            }
        }
    });
    return picture;
}

} // namespace metamarch::tests
