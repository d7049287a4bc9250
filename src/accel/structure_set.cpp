#include "metamarch/accel/structure_set.h"

#include "metamarch/accel/kd_links.h"

#include <algorithm>

namespace metamarch {
namespace {

// Every solid triangle lies in some leaf.
std::vector<TriangleRecord> uniqueTriangles(std::vector<TriangleRecord> triangles) {
    std::ranges::sort(triangles, {}, &TriangleRecord::triangleId);
    const auto repeated = std::ranges::unique(triangles, {}, &TriangleRecord::triangleId);
    triangles.erase(repeated.begin(), repeated.end());
    return triangles;
}

// Without those that come again.
std::vector<TriangleRecord> firstOccurrences(const std::vector<TriangleRecord>& triangles) {
    std::vector<TriangleRecord> first;
    std::vector<bool> seen; // [triangleId]
    for (const TriangleRecord& triangle : triangles) {
        if (triangle.triangleId >= seen.size()) {
            seen.resize(std::size_t{triangle.triangleId} + 1);
        }
        if (!seen[triangle.triangleId]) {
            seen[triangle.triangleId] = true;
            first.push_back(triangle);
        }
    }
    return first;
}

} // namespace

const std::vector<KdParent>& StructureSet::kdParents() const {
    tbb::collaborative_call_once(lazyParents.once, [&] {
        lazyParents.value = linkParents(accelerationStructure.lattice, accelerationStructure.tree);
    });
    return lazyParents.value;
}

const std::vector<std::uint32_t>& StructureSet::kdRopes() const {
    tbb::collaborative_call_once(lazyRopes.once,
                                 [&] { lazyRopes.value = tieRopes(accelerationStructure.tree); });
    return lazyRopes.value;
}

const Bvh& StructureSet::bvh() const {
    tbb::collaborative_call_once(
        lazyBvh.once, [&] { lazyBvh.value = buildBvh(accelerationStructure.lattice, triangles()); });
    return lazyBvh.value;
}

const UniformGrid& StructureSet::uniformGrid() const {
    tbb::collaborative_call_once(lazyGrid.once, [&] {
        lazyGrid.value = buildUniformGrid(accelerationStructure.lattice, triangles());
    });
    return lazyGrid.value;
}

const RectilinearTable& StructureSet::rectilinearTable() const {
    tbb::collaborative_call_once(lazyRectilinear.once, [&] {
        const AccelerationOptions& options = accelerationStructure.options;
        const bool isWanted = options.table == TableMethod::rectilinear && options.treeDepth;
        const unsigned limit =
            options.treeDepth.value_or(defaultTreeDepth(accelerationStructure.lattice.triangleCount));
        lazyRectilinear.value = buildRectilinearTable(accelerationStructure.lattice, triangles(),
                                                      {limit, isWanted}, options.exitBoxes);
    });
    return *lazyRectilinear.value;
}

const std::vector<TriangleRecord>& StructureSet::triangles() const {
    tbb::collaborative_call_once(
        lazyTriangles.once, [&] { lazyTriangles.value = uniqueTriangles(accelerationStructure.triangles); });
    return lazyTriangles.value;
}

const std::vector<TriangleRecord>& StructureSet::spatialTriangles() const {
    tbb::collaborative_call_once(lazySpatialTriangles.once, [&] {
        lazySpatialTriangles.value = firstOccurrences(accelerationStructure.triangles);
    });
    return lazySpatialTriangles.value;
}

} // namespace metamarch
