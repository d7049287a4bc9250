// SPDX-License-Identifier: MIT
#include "metamarch/accel/split_plan.h"

#include "metamarch/accel/lattice.h"
#include "metamarch/accel/split.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

namespace metamarch {
namespace {

// Planes are later rounded to single precision, which moves them by at most 2^-6 of the margin. With this
// much extra room, a rounded plane still does not cut the triangle at whose end it lies.
constexpr double kPlaneRoom = 1.0 + 0x1p-6;

// One thread builds a node with fewer references.
constexpr std::size_t kSerial = 1u << 12u;

// The part of a triangle that lies in a node.
struct Extent {
    std::uint32_t triangle;
    Box box; // grown by the margin
};

struct Plane {
    unsigned axis;
    double at;
    double cost;
};

struct PlanNode {
    Plane plane{kNoSplit, 0.0, 0.0};
    std::unique_ptr<PlanNode> below; // both or none
    std::unique_ptr<PlanNode> above;
};

class Planner {
  public:
    Planner(const Lattice& lattice, std::span<const LatticeTriangle> usedTriangles, unsigned depthLimit)
        : triangles(usedTriangles), maxDepth(depthLimit), margin(kPlaneRoom * referenceMargin(lattice)),
          cellSize(1.0 / glm::dvec3(lattice.cellsPerUnit)),
          whole{glm::dvec3(0.0), glm::dvec3(lattice.resolution)} {}

    std::unique_ptr<PlanNode> plan() const {
        std::vector<Extent> extents;
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            add(i, whole, extents);
        }
        return planNode(whole, std::move(extents), 0);
    }

  private:
    void add(const std::uint32_t triangle, const Box& box, std::vector<Extent>& extents) const {
        if (const auto part = clipTriangle(triangles[triangle], {box.lo - margin, box.hi + margin})) {
            extents.push_back({triangle, {part->lo - margin, part->hi + margin}});
        }
    }

    std::unique_ptr<PlanNode> planNode(const Box& box, std::vector<Extent> extents,
                                       const unsigned depth) const {
        auto node = std::make_unique<PlanNode>();
        const std::optional<Plane> plane =
            extents.empty() || depth == maxDepth ? std::nullopt : findPlane(extents, box);
        if (!plane || plane->cost >= leafCost(extents.size())) {
            return node;
        }
        node->plane = *plane;
        const int axis = static_cast<int>(plane->axis);
        Box boxBelow = box;
        Box boxAbove = box;
        boxBelow.hi[axis] = plane->at;
        boxAbove.lo[axis] = plane->at;
        std::vector<Extent> below;
        std::vector<Extent> above;
        for (const Extent& extent : extents) {
            if (extent.box.hi[axis] <= plane->at) {
                below.push_back(extent);
            } else if (extent.box.lo[axis] >= plane->at) {
                above.push_back(extent);
            } else {
                add(extent.triangle, boxBelow, below);
                add(extent.triangle, boxAbove, above);
            }
        }
        const bool parallel = extents.size() > kSerial;
        std::vector<Extent>().swap(extents); // free the memory; the two children need it
        if (parallel) {
            tbb::task_group tasks;
            tasks.run([&] { node->below = planNode(boxBelow, std::move(below), depth + 1); });
            node->above = planNode(boxAbove, std::move(above), depth + 1);
            tasks.wait();
        } else {
            node->below = planNode(boxBelow, std::move(below), depth + 1);
            node->above = planNode(boxAbove, std::move(above), depth + 1);
        }
        return node;
    }

    // Among equal costs, the lowest axis and then the lowest plane win.
    std::optional<Plane> findPlane(const std::vector<Extent>& extents, const Box& box) const {
        std::array<std::optional<Plane>, 3> candidates;
        const auto sweep = [&](const unsigned axis) { candidates[axis] = sweepAxis(extents, box, axis); };
        if (extents.size() > kSerial) {
            tbb::parallel_for(0u, 3u, sweep);
        } else {
            for (unsigned axis = 0; axis < 3; ++axis) {
                sweep(axis);
            }
        }
        std::optional<Plane> best;
        for (const std::optional<Plane>& candidate : candidates) {
            if (candidate && (!best || candidate->cost < best->cost)) {
                best = candidate;
            }
        }
        return best;
    }

    std::optional<Plane> sweepAxis(const std::vector<Extent>& extents, const Box& box,
                                   const unsigned axisId) const {
        const int axis = static_cast<int>(axisId);
        std::vector<double> begins;
        std::vector<double> ends;
        begins.reserve(extents.size());
        ends.reserve(extents.size());
        for (const Extent& extent : extents) {
            begins.push_back(extent.box.lo[axis]);
            ends.push_back(extent.box.hi[axis]);
        }
        std::ranges::sort(begins);
        std::ranges::sort(ends);

        const SplitCost costOf((box.hi - box.lo) * cellSize, axisId);
        std::optional<Plane> best;
        std::size_t begun = 0; // number of extents that begin below the plane
        std::size_t ended = 0; // number of extents that end below or at the plane
        for (std::size_t nextBegin = 0, nextEnd = 0; nextEnd < ends.size();) {
            // The extent that ends last begins before it ends, so `begins` runs out before `ends` does.
            const bool isBegin = nextBegin < begins.size() && begins[nextBegin] <= ends[nextEnd];
            const double at = isBegin ? begins[nextBegin++] : ends[nextEnd++];
            while (begun < begins.size() && begins[begun] < at) {
                ++begun;
            }
            while (ended < ends.size() && ends[ended] <= at) {
                ++ended;
            }
            if (at <= box.lo[axis] || at >= box.hi[axis]) {
                continue;
            }
            const double cost = costOf((at - box.lo[axis]) * cellSize[axis], begun, extents.size() - ended);
            if (!best || cost < best->cost) {
                best = Plane{axisId, at, cost};
            }
        }
        return best;
    }

    std::span<const LatticeTriangle> triangles;
    unsigned maxDepth;
    glm::dvec3 margin;
    glm::dvec3 cellSize;
    Box whole;
};

// Appends the nodes to the flat array, depth-first. The recursion is at most kMaxTreeDepth deep.
void flatten(const PlanNode& node, const unsigned depth, SplitPlan& plan) {
    plan.depth = std::max(plan.depth, depth);
    const std::size_t index = plan.nodes.size();
    plan.nodes.push_back({node.plane.axis, node.plane.at, 0});
    if (node.below) {
        flatten(*node.below, depth + 1, plan);
        plan.nodes[index].above = static_cast<std::uint32_t>(plan.nodes.size());
        flatten(*node.above, depth + 1, plan);
    }
}

} // namespace

SplitPlan planSplits(const Lattice& lattice, const std::span<const LatticeTriangle> triangles,
                     const unsigned maxDepth) {
    SplitPlan plan;
    flatten(*Planner(lattice, triangles, maxDepth).plan(), 0, plan);
    return plan;
}

} // namespace metamarch
