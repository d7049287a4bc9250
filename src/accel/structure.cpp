// SPDX-License-Identifier: MIT
#include "metamarch/accel/structure.h"

#include "metamarch/shared/reference_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace metamarch {
namespace {

using Set = StructureSet;
using Triangles = std::span<const TriangleRecord>;

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

template <class T>
std::span<const std::byte> bytesOf(const T& constants) {
    return std::as_bytes(std::span(&constants, 1));
}

Triangles inTreeLeaves(const Set& set) { return set.kdTree().triangles; }

double treeSeconds(const Set& set) { return set.kdTree().treeSeconds; }

constexpr StructurePart kLeaves{"leaves", kBindLeaves, 4,
                                [](const Set& set) { return bytesOf(set.kdTree().tree.leaves); }};
constexpr StructurePart kNodes{"kd-tree nodes", kBindKdNodes, 2,
                               [](const Set& set) { return bytesOf(set.kdTree().tree.nodes); }};

// An entry of a brick and one of a cell, few whole bricks lying near surfaces, and the leaf or its head.
// Entries are loaded with their neighbours, four words at once.
constexpr std::uint64_t kTableVisit = 2 * (4 * sizeof(std::uint32_t)) + sizeof(Leaf);

std::span<const Structure> structures() {
    static const Structure kStructures[] = {
        {"meta_table",
         [](const Set& set) -> Triangles { return set.kdTree().table.triangles; },
         {{"array of leaf records", kBindLeaves, 4,
           [](const Set& set) { return bytesOf(set.kdTree().table.leafRecords); }},
          {"meta table", kBindTable, 4,
           [](const Set& set) { return bytesOf(set.kdTree().table.recordWords); }}},
         kTableVisit + sizeof(LeafFrame),
         [](const Set& set) { return set.kdTree().treeSeconds + set.kdTree().tableSeconds; }},
        // Three planes for the exit and, behind it, three look-ups with one plane each.
        {"rectilinear_table",
         [](const Set& set) -> Triangles { return set.rectilinearTable().table.triangles; },
         {{"rectilinear lattice", kBindRectilinear, 0,
           [](const Set& set) { return bytesOf(set.rectilinearTable().planes.layout()); }},
          {"planes", kBindPlanes, 1,
           [](const Set& set) { return bytesOf(set.rectilinearTable().planes.planes()); }},
          {"plane look-ups", kBindBuckets, 1,
           [](const Set& set) { return bytesOf(set.rectilinearTable().planes.buckets()); }},
          {"rectilinear exit boxes", kBindLeaves, 4,
           [](const Set& set) { return bytesOf(set.rectilinearTable().table.leaves); }},
          {"rectilinear table", kBindTable, 4,
           [](const Set& set) { return bytesOf(set.rectilinearTable().table.words); }}},
         kTableVisit + 3 * sizeof(float) + 3 * (sizeof(std::uint32_t) + sizeof(float)),
         [](const Set& set) { return set.rectilinearTable.seconds(); }},
        {"kd_tree", inTreeLeaves, {kLeaves, kNodes}, sizeof(KdNode), treeSeconds},
        {"kd_parents",
         inTreeLeaves,
         {kLeaves,
          kNodes,
          {"kd-tree parents", kBindKdParents, 4, [](const Set& set) { return bytesOf(set.kdParents()); }}},
         sizeof(KdNode),
         [](const Set& set) { return treeSeconds(set) + set.kdParents.seconds(); }},
        {"kd_ropes",
         inTreeLeaves,
         {kLeaves,
          kNodes,
          {"kd-tree ropes", kBindKdRopes, 1, [](const Set& set) { return bytesOf(set.kdRopes()); }}},
         sizeof(KdNode),
         [](const Set& set) { return treeSeconds(set) + set.kdRopes.seconds(); }},
        {"bvh",
         [](const Set& set) -> Triangles { return set.bvh().triangles; },
         {{"BVH nodes", kBindBvhNodes, 4, [](const Set& set) { return bytesOf(set.bvh().nodes); }}},
         sizeof(BvhNode),
         [](const Set& set) { return set.bvh.seconds(); }},
        {"wide_bvh",
         [](const Set& set) -> Triangles { return set.bvh().triangles; },
         {{"wide BVH nodes", kBindBvhNodes, 4, [](const Set& set) { return bytesOf(set.wideBvh()); }}},
         sizeof(WideBvhNode),
         [](const Set& set) { return set.bvh.seconds() + set.wideBvh.seconds(); }},
        {"uniform_grid",
         [](const Set& set) -> Triangles { return set.uniformGrid().triangles; },
         {{"grid", kBindGrid, 0, [](const Set& set) { return bytesOf(set.uniformGrid().grid); }},
          {"grid cells", kBindGridCells, 2, [](const Set& set) { return bytesOf(set.uniformGrid().cells); }}},
         sizeof(GridCell),
         [](const Set& set) { return set.uniformGrid.seconds(); }},
        {"triangles", [](const Set& set) -> Triangles { return set.triangles(); }, {}},
        {"leaf_triangles", inTreeLeaves, {}},
        {.name = "boxes",
         .triangles = [](const Set& set) -> Triangles { return set.spatialTriangles(); },
         .parts = {},
         .isWalkedByDriver = true},
    };
    return kStructures;
}

} // namespace

std::uint64_t byteSize(const Structure& structure, const StructureSet& set) {
    std::uint64_t bytes = structure.triangles(set).size_bytes();
    for (const StructurePart& part : structure.parts) {
        bytes += part.words == 0 ? 0 : part.data(set).size();
    }
    return bytes;
}

const Structure& findStructure(const std::string_view name) {
    const auto found = std::ranges::find(structures(), name, &Structure::name);
    if (found == structures().end()) {
        throw std::logic_error(fmt::format("no structure '{}'", name));
    }
    return *found;
}

} // namespace metamarch
