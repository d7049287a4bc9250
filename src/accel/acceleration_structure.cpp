// SPDX-License-Identifier: MIT
#include "metamarch/accel/acceleration_structure.h"

#include "metamarch/accel/exit_boxes.h"
#include "metamarch/accel/leaf_merging.h"
#include "metamarch/accel/reference_boxes.h"
#include "metamarch/error/error.h"
#include "metamarch/shared/triangle.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace metamarch {
namespace {

// Returns the seconds since `start` and sets `start` to now.
double lap(std::chrono::steady_clock::time_point& start) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start).count();
    start = now;
    return seconds;
}

// Returns true if this file chooses the number of cells, and not the user.
bool choosesCells(const AccelerationOptions& options) {
    return !options.unit && !options.cells && !options.partition && options.table != TableMethod::gcd;
}

// Divides the number of cells if the table of a lattice chosen here exceeds its budget; then builds again.
constexpr std::uint32_t kCoarser = 4;

MetaTable buildTable(const LeafList& list, const TriangleMesh& mesh, const Lattice& lattice,
                     const AccelerationOptions& options, const std::uint64_t budget) {
    MetaTable table = buildMetaTable(lattice.resolution, list.leaves, budget);
    if (options.exitBoxes) {
        growExitBoxes(list, table);
    }
    const SharedTriangles shared = shareTriangles(list.leafTriangles, mesh.triangles.size());
    table.triangles = makeTriangleRecords(mesh, shared.ids);
    recordLeaves(lattice, shared.indices, table);
    return table;
}

glm::vec3 corner(const TriangleMesh& mesh, const std::uint32_t triangleId, const int i) {
    return mesh.positions[mesh.triangles[triangleId][i]];
}

std::vector<LatticeTriangle> cornersIn(const Lattice& lattice, const TriangleMesh& mesh,
                                       const std::vector<std::uint32_t>& ids) {
    std::vector<LatticeTriangle> corners(ids.size());
    tbb::parallel_for(std::size_t{0}, ids.size(), [&](const std::size_t i) {
        for (int k = 0; k < 3; ++k) {
            corners[i][static_cast<std::size_t>(k)] = toLattice(lattice, corner(mesh, ids[i], k));
        }
    });
    return corners;
}

// Returns the median of the triangles' longest edges.
double typicalEdgeOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids) {
    if (ids.empty()) {
        return 0.0;
    }
    std::vector<float> edges(ids.size());
    tbb::parallel_for(std::size_t{0}, ids.size(), [&](const std::size_t i) {
        const glm::vec3 a = corner(mesh, ids[i], 0);
        const glm::vec3 b = corner(mesh, ids[i], 1);
        const glm::vec3 c = corner(mesh, ids[i], 2);
        edges[i] = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    });
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::ranges::nth_element(edges, middle);
    return *middle;
}

// Chooses the lattice and builds the tree on it. Returns the triangles in lattice space.
std::vector<LatticeTriangle> layTree(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids,
                                     const AccelerationOptions& options, const unsigned depth,
                                     AccelerationStructure& result) {
    const auto count = static_cast<std::uint32_t>(ids.size());
    if (options.table != TableMethod::gcd) {
        const LatticeChoice choice = makeLattice(boundsOf(mesh), count, options, typicalEdgeOf(mesh, ids));
        result.lattice = choice.lattice;
        result.unit = choice.unit;
        std::vector<LatticeTriangle> corners = cornersIn(result.lattice, mesh, ids);
        result.tree = buildKdTree(result.lattice, corners, ids, depth);
        return corners;
    }
    const LatticeChoice quanta = makeQuantumLattice(boundsOf(mesh), count, options.quantum);
    const GcdLattice gcd = makeGcdLattice(
        quanta.lattice, planSplits(quanta.lattice, cornersIn(quanta.lattice, mesh, ids), depth));
    result.lattice = gcd.lattice;
    result.rounding = gcd.rounding;
    result.unit = quanta.unit * glm::dvec3(gcd.rounding.quantaPerCell);
    std::vector<LatticeTriangle> corners = cornersIn(result.lattice, mesh, ids);
    const auto cellsOf = [margin = referenceMargin(result.lattice)](const LatticeTriangle& triangle,
                                                                    const CellRange& box) {
        return touchedCells(triangle, box, margin);
    };
    result.tree = buildPlannedKdTree(result.lattice.resolution, cellsOf, corners, ids, gcd.plan);
    return corners;
}

// Builds tree and table over the triangles `ids`; the table may take at most `budget` bytes.
void build(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids,
           const AccelerationOptions& options, const unsigned depth, const std::uint64_t budget,
           AccelerationStructure& result) {
    auto clock = std::chrono::steady_clock::now();
    const std::vector<LatticeTriangle> corners = layTree(mesh, ids, options, depth, result);
    result.triangles = makeTriangleRecords(mesh, result.tree.leafTriangles);
    result.treeSeconds = lap(clock);
    if (options.partition) {
        const auto list = listTriangles(result.lattice, options.partition->boxes, corners, ids);
        result.table = buildTable(list, mesh, result.lattice, options, budget);
    } else if (options.mergeLeaves) {
        result.table =
            buildTable(mergeLeaves(result.lattice, result.tree), mesh, result.lattice, options, budget);
    } else {
        result.table = buildTable(result.tree, mesh, result.lattice, options, budget);
    }
    result.tableSeconds = lap(clock);
}

} // namespace

std::vector<std::uint32_t> nonDegenerateTriangles(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> ids;
    ids.reserve(mesh.triangles.size());
    for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) {
        const vec3 normal = scaledNormal(corner(mesh, id, 0), corner(mesh, id, 1), corner(mesh, id, 2));
        if (largest(abs(normal)) >= kSmallestNormal) {
            ids.push_back(id);
        }
    }
    return ids;
}

std::vector<TriangleRecord> makeTriangleRecords(const TriangleMesh& mesh,
                                                const std::vector<std::uint32_t>& triangleIds) {
    std::vector<TriangleRecord> records(triangleIds.size());
    tbb::parallel_for(std::size_t{0}, triangleIds.size(), [&](const std::size_t recordIndex) {
        const std::uint32_t id = triangleIds[recordIndex];
        records[recordIndex] = {corner(mesh, id, 0), id, corner(mesh, id, 1), 0, corner(mesh, id, 2), 0};
    });
    return records;
}

AccelerationStructure buildAccelerationStructure(const TriangleMesh& mesh,
                                                 const AccelerationOptions& options) {
    const std::vector<std::uint32_t> ids = nonDegenerateTriangles(mesh);
    const unsigned depth =
        options.treeDepth.value_or(defaultTreeDepth(static_cast<std::uint32_t>(ids.size())));
    if (depth > kMaxTreeDepth) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("a tree depth of {} is over the limit of {}", depth, kMaxTreeDepth),
                    {"treeDepth"});
    }

    AccelerationStructure result;
    result.degenerateTriangles = static_cast<std::uint32_t>(mesh.triangles.size() - ids.size());
    AccelerationOptions tried = options;
    // The loop ends because each retry has fewer cells, and a table of few cells takes few bytes.
    for (bool fits = false; !fits;) {
        try {
            build(mesh, ids, tried, depth, choosesCells(options) ? kAutomaticTableBudget : kTableBudget,
                  result);
            fits = true;
        } catch (const TableOverBudget&) {
            if (!choosesCells(options)) {
                throw;
            }
            tried.cells = result.lattice.cellCount / kCoarser;
        }
    }
    result.options = options;
    return result;
}

} // namespace metamarch
