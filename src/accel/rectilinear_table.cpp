// SPDX-License-Identifier: MIT
#include "metamarch/accel/rectilinear_table.h"

#include "metamarch/accel/exit_boxes.h"
#include "metamarch/accel/kd_tree.h"
#include "metamarch/accel/lattice.h"
#include "metamarch/error/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>

namespace metamarch {
namespace {

// Number of levels that are planned first. It doubles for as long as all of the levels and their planes fit.
constexpr unsigned kFirstLevels = 12;

std::vector<LatticeTriangle> cornersIn(const Lattice& lattice,
                                       const std::span<const TriangleRecord> triangles) {
    std::vector<LatticeTriangle> corners(triangles.size());
    tbb::parallel_for(std::size_t{0}, triangles.size(), [&](const std::size_t i) {
        corners[i] = {toLattice(lattice, triangles[i].v0), toLattice(lattice, triangles[i].v1),
                      toLattice(lattice, triangles[i].v2)};
    });
    return corners;
}

// Calls visit(node, depth) for each inner node of the plan whose depth is less than `levels`. The recursion
// is at most kMaxTreeDepth deep.
template <class Visit>
void visitSplits(const SplitPlan& plan, const std::uint32_t nodeId, const unsigned depth,
                 const unsigned levels, const Visit& visit) {
    const PlannedNode& node = plan.nodes[nodeId];
    if (node.axis != kNoSplit && depth < levels) {
        visit(node, depth);
        visitSplits(plan, nodeId + 1, depth + 1, levels, visit);
        visitSplits(plan, node.above, depth + 1, levels, visit);
    }
}

RectilinearPlanes planesOf(const Lattice& lattice, const SplitPlan& plan, const unsigned levels) {
    std::array<std::vector<float>, 3> planes;
    visitSplits(plan, 0, 0, levels, [&](const PlannedNode& node, unsigned) {
        planes[node.axis].push_back(static_cast<float>(node.plane));
    });
    return RectilinearPlanes(std::move(planes), vec3(lattice.resolution));
}

// Returns the number of cells on each axis, indexed by the number of levels after which the tree is cut.
std::vector<glm::dvec3> countCells(const SplitPlan& plan) {
    struct FirstUse {
        float plane;
        unsigned depth;
        auto operator<=>(const FirstUse&) const = default;
    };
    std::array<std::vector<FirstUse>, 3> uses;
    visitSplits(plan, 0, 0, plan.depth, [&](const PlannedNode& node, const unsigned depth) {
        uses[node.axis].push_back({static_cast<float>(node.plane), depth});
    });
    std::vector<glm::dvec3> counts(plan.depth + 1, glm::dvec3(1.0));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::ranges::sort(uses[axis]); // the shallowest use of a plane comes first
        const auto repeated = std::ranges::unique(uses[axis], {}, &FirstUse::plane);
        uses[axis].erase(repeated.begin(), repeated.end());
        for (const FirstUse& use : uses[axis]) {
            for (unsigned levels = use.depth + 1; levels < counts.size(); ++levels) {
                counts[levels][static_cast<int>(axis)] += 1.0;
            }
        }
    }
    return counts;
}

bool fits(const glm::dvec3& counts, const double mostCells) {
    return std::max({counts.x, counts.y, counts.z}) <= kMaxLatticeResolution &&
           counts.x * counts.y * counts.z <= mostCells;
}

// Considers 0 to counts.size() - 1 levels. With 0 levels there is one cell, which always fits.
unsigned deepestThatFits(const std::vector<glm::dvec3>& counts, const double mostCells) {
    unsigned levels = 0;
    while (levels + 1 < counts.size() && fits(counts[levels + 1], mostCells)) {
        ++levels;
    }
    return levels;
}

struct ChosenPlan {
    SplitPlan plan;
    unsigned levels; // number of the plan's levels to use
};

constexpr double kMostCells = static_cast<double>(kTableBudget) / sizeof(std::uint32_t);

ChosenPlan choosePlan(const Lattice& lattice, const std::span<const LatticeTriangle> corners,
                      const RectilinearDepth depth) {
    if (depth.isWanted) {
        SplitPlan plan = planSplits(lattice, corners, depth.limit);
        const std::vector<glm::dvec3> counts = countCells(plan);
        const glm::dvec3 needed = counts.back();
        if (!fits(needed, kMostCells)) {
            throw Error(
                ErrorKind::outOfMemory,
                fmt::format("a rectilinear table of tree depth {} has {:.0f} x {:.0f} x {:.0f} cells "
                            "({:.0f} MiB), more than {} on an axis or {} MiB; the deepest that fits is {}",
                            depth.limit, needed.x, needed.y, needed.z,
                            needed.x * needed.y * needed.z * sizeof(std::uint32_t) / 0x1p20,
                            kMaxLatticeResolution, kTableBudget >> 20u, deepestThatFits(counts, kMostCells)),
                {"treeDepth"});
        }
        const unsigned levels = plan.depth;
        return {std::move(plan), levels};
    }
    for (unsigned limit = std::min(kFirstLevels, depth.limit);; limit = std::min(2 * limit, depth.limit)) {
        SplitPlan plan = planSplits(lattice, corners, limit);
        const unsigned levels = deepestThatFits(countCells(plan), kMostAutomaticCells);
        if (levels < limit || limit == depth.limit) {
            return {std::move(plan), levels};
        }
    }
}

// Copies the first `levels` levels of the plan and replaces its planes by their indices.
void number(const SplitPlan& plan, const std::uint32_t nodeId, const unsigned levels,
            const RectilinearPlanes& planes, SplitPlan& numbered) {
    const PlannedNode& node = plan.nodes[nodeId];
    const std::size_t index = numbered.nodes.size();
    if (node.axis == kNoSplit || levels == 0) {
        numbered.nodes.push_back({kNoSplit, 0.0, 0});
        return;
    }
    const std::uint32_t plane = planes.numberOf(static_cast<int>(node.axis), static_cast<float>(node.plane));
    numbered.nodes.push_back({node.axis, static_cast<double>(plane), 0});
    number(plan, nodeId + 1, levels - 1, planes, numbered);
    numbered.nodes[index].above = static_cast<std::uint32_t>(numbered.nodes.size());
    number(plan, node.above, levels - 1, planes, numbered);
}

} // namespace

RectilinearTable buildRectilinearTable(const Lattice& lattice,
                                       const std::span<const TriangleRecord> triangles,
                                       const RectilinearDepth depth, const bool exitBoxes) {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<LatticeTriangle> corners = cornersIn(lattice, triangles);
    const auto [plan, levels] = choosePlan(lattice, corners, depth);
    RectilinearTable result{planesOf(lattice, plan, levels), {}, 0, 0.0};
    SplitPlan numbered;
    number(plan, 0, levels, result.planes, numbered);

    // References name the place in `triangles`, not the triangle's id.
    std::vector<std::uint32_t> recordIndices(triangles.size());
    std::iota(recordIndices.begin(), recordIndices.end(), 0u);
    const auto cellsOf = [&, margin = referenceMargin(lattice)](const LatticeTriangle& triangle,
                                                                const CellRange& box) {
        return result.planes.touchedCells(triangle, box, margin);
    };
    const uvec3 resolution = result.planes.layout().resolution;
    const KdTree tree = buildPlannedKdTree(resolution, cellsOf, corners, recordIndices, numbered);
    result.depth = tree.depth;
    result.table = buildMetaTable(resolution, tree.leaves);
    if (exitBoxes) {
        growExitBoxes(tree, result.table);
    }
    for (const std::uint32_t recordIndex : tree.leafTriangles) {
        result.table.triangles.push_back(triangles[recordIndex]);
    }
    result.buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace metamarch
