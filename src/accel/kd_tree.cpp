// SPDX-License-Identifier: MIT
#include "metamarch/accel/kd_tree.h"

#include "metamarch/accel/lattice.h"
#include "metamarch/accel/split.h"
#include "metamarch/error/error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>

namespace metamarch {
namespace {

using References = std::vector<TriangleReference>;

// Number of references per task. One thread builds a node with fewer.
constexpr std::size_t kChunk = 1u << 13u;

struct BuildNode {
    CellRange box;
    unsigned axis = 0;
    std::uint16_t plane = 0;
    std::unique_ptr<BuildNode> below; // either both or none
    std::unique_ptr<BuildNode> above;
    std::vector<std::uint32_t> triangleIds; // leaves only
};

struct Children {
    References below;
    References above;
};

// A chosen split and the splitter's state for each child.
struct Cut {
    unsigned axis;
    std::uint16_t plane;
    std::uint32_t below;
    std::uint32_t above;
};

// Splits by the surface area heuristic. The state is the depth.
class CostSplitter {
  public:
    CostSplitter(const Lattice& lattice, const unsigned depthLimit)
        : maxDepth(depthLimit), cellSize(1.0 / glm::dvec3(lattice.cellsPerUnit)) {}

    std::optional<Cut> operator()(const References& references, const CellRange& box,
                                  const std::uint32_t depth) const {
        const std::optional<Split> split =
            depth == maxDepth ? std::nullopt : findSplit(references, box, cellSize);
        if (!split || split->cost >= leafCost(references.size())) {
            return std::nullopt;
        }
        return Cut{split->axis, split->plane, depth + 1, depth + 1};
    }

  private:
    std::uint32_t maxDepth;
    glm::dvec3 cellSize;
};

// Splits by a plan. The state is the index of a node in the plan.
class PlanSplitter {
  public:
    explicit PlanSplitter(const SplitPlan& usedPlan) : plan(usedPlan) {}

    std::optional<Cut> operator()(const References&, const CellRange& box, std::uint32_t nodeId) const {
        while (plan.nodes[nodeId].axis != kNoSplit) {
            const PlannedNode& node = plan.nodes[nodeId];
            if (node.plane <= box.lo[node.axis]) {
                nodeId = node.above;
            } else if (node.plane > box.hi[node.axis]) {
                nodeId = nodeId + 1;
            } else {
                return Cut{node.axis, static_cast<std::uint16_t>(node.plane), nodeId + 1, node.above};
            }
        }
        return std::nullopt;
    }

  private:
    const SplitPlan& plan;
};

using Splitter = std::function<std::optional<Cut>(const References& references, const CellRange& box,
                                                  std::uint32_t state)>;

class Builder {
  public:
    Builder(const uvec3 resolution, std::span<const LatticeTriangle> triangles,
            std::span<const std::uint32_t> triangleIds, CellsOfTriangle usedCells, Splitter usedSplitter)
        : corners(triangles), ids(triangleIds), cellsOf(std::move(usedCells)),
          splitter(std::move(usedSplitter)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            root.lo[axis] = 0;
            root.hi[axis] = static_cast<std::uint16_t>(resolution[static_cast<int>(axis)] - 1);
        }
    }

    std::unique_ptr<BuildNode> build() const {
        References references(corners.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners.size(), kChunk), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                // The box is the whole lattice, so part of every triangle lies in it.
                references[i] = {static_cast<std::uint32_t>(i), *cellsOf(corners[i], root)};
            }
        });
        return buildNode(root, std::move(references), 0);
    }

  private:
    std::unique_ptr<BuildNode> buildNode(const CellRange& box, References references,
                                         const std::uint32_t state) const {
        auto node = std::make_unique<BuildNode>();
        node->box = box;
        const std::optional<Cut> cut = references.empty() ? std::nullopt : splitter(references, box, state);
        if (!cut) {
            node->triangleIds.reserve(references.size());
            for (const TriangleReference& reference : references) {
                node->triangleIds.push_back(ids[reference.triangleId]);
            }
            return node;
        }

        node->axis = cut->axis;
        node->plane = cut->plane;
        CellRange boxBelow = box;
        CellRange boxAbove = box;
        boxBelow.hi[cut->axis] = static_cast<std::uint16_t>(cut->plane - 1);
        boxAbove.lo[cut->axis] = cut->plane;
        Children children = distribute(references, *cut, boxBelow, boxAbove);
        const bool parallel = references.size() > kChunk;
        References().swap(references); // free the memory; the two children need it

        if (parallel) {
            tbb::task_group tasks;
            tasks.run([&] { node->below = buildNode(boxBelow, std::move(children.below), cut->below); });
            node->above = buildNode(boxAbove, std::move(children.above), cut->above);
            tasks.wait();
        } else {
            node->below = buildNode(boxBelow, std::move(children.below), cut->below);
            node->above = buildNode(boxAbove, std::move(children.above), cut->above);
        }
        return node;
    }

    // Distributes the references to the children chunk by chunk, in order, so that the result does not depend
    // on the number of threads.
    Children distribute(const References& references, const Cut& cut, const CellRange& boxBelow,
                        const CellRange& boxAbove) const {
        const std::size_t chunkCount = (references.size() + kChunk - 1) / kChunk;
        std::vector<Children> chunks(chunkCount);
        tbb::parallel_for(std::size_t{0}, chunkCount, [&](const std::size_t chunk) {
            const std::size_t begin = chunk * kChunk;
            const std::size_t end = std::min(references.size(), begin + kChunk);
            chunks[chunk].below.reserve(end - begin);
            chunks[chunk].above.reserve(end - begin);
            for (std::size_t i = begin; i < end; ++i) {
                hand(references[i], cut, boxBelow, boxAbove, chunks[chunk]);
            }
        });
        if (chunkCount == 1) {
            return std::move(chunks.front());
        }
        Children children;
        const auto countOf = [&](References Children::*const side) {
            return std::transform_reduce(chunks.begin(), chunks.end(), std::size_t{0}, std::plus(),
                                         [side](const Children& chunk) { return (chunk.*side).size(); });
        };
        children.below.reserve(countOf(&Children::below));
        children.above.reserve(countOf(&Children::above));
        for (std::size_t i = 0; i < chunkCount; ++i) {
            children.below.insert(children.below.end(), chunks[i].below.begin(), chunks[i].below.end());
            children.above.insert(children.above.end(), chunks[i].above.begin(), chunks[i].above.end());
        }
        return children;
    }

    void hand(const TriangleReference& reference, const Cut& cut, const CellRange& boxBelow,
              const CellRange& boxAbove, Children& children) const {
        if (reference.cells.hi[cut.axis] < cut.plane) {
            children.below.push_back(reference);
        } else if (reference.cells.lo[cut.axis] >= cut.plane) {
            children.above.push_back(reference);
        } else {
            const LatticeTriangle& triangle = corners[reference.triangleId];
            if (const auto cells = cellsOf(triangle, boxBelow)) {
                children.below.push_back({reference.triangleId, *cells});
            }
            if (const auto cells = cellsOf(triangle, boxAbove)) {
                children.above.push_back({reference.triangleId, *cells});
            }
        }
    }

    std::span<const LatticeTriangle> corners;
    std::span<const std::uint32_t> ids;
    CellsOfTriangle cellsOf;
    Splitter splitter;
    CellRange root{};
};

glm::uvec3 toCell(const CellCorner& corner) { return {corner[0], corner[1], corner[2]}; }

void refuseOver32Bits(const std::size_t count, const char* what) {
    if (count >= (std::size_t{1} << 30u)) {
        throw Error(ErrorKind::outOfMemory,
                    std::string("the kd-tree has more than 2^30 ") + what +
                        "; choose a smaller tree depth or fewer cells",
                    {"treeDepth", "cells"});
    }
}

// Appends the nodes to the flat arrays, depth-first. The recursion is at most kMaxTreeDepth deep.
void flatten(const BuildNode& node, const unsigned depth, KdTree& tree) {
    tree.depth = std::max(tree.depth, depth);
    const std::size_t index = tree.nodes.size();
    refuseOver32Bits(index, "nodes");
    if (node.below) {
        tree.nodes.push_back({node.axis | static_cast<std::uint32_t>(node.plane) << 2u, 0});
        flatten(*node.below, depth + 1, tree);
        tree.nodes[index].target = static_cast<std::uint32_t>(tree.nodes.size());
        flatten(*node.above, depth + 1, tree);
    } else {
        tree.nodes.push_back({3u, static_cast<std::uint32_t>(tree.leaves.size())});
        tree.leaves.push_back({packCell(toCell(node.box.lo)), packCell(toCell(node.box.hi) + 1u),
                               static_cast<std::uint32_t>(tree.leafTriangles.size()),
                               static_cast<std::uint32_t>(node.triangleIds.size())});
        tree.leafTriangles.insert(tree.leafTriangles.end(), node.triangleIds.begin(), node.triangleIds.end());
        refuseOver32Bits(tree.leafTriangles.size(), "references");
    }
}

KdTree flattened(const Builder& builder) {
    KdTree tree;
    flatten(*builder.build(), 0, tree);
    return tree;
}

} // namespace

unsigned defaultTreeDepth(const std::uint32_t triangleCount) {
    const double depth = 8.0 + 1.3 * std::log2(std::max(triangleCount, 1u));
    return std::min(static_cast<unsigned>(std::lround(depth)), static_cast<unsigned>(kMaxTreeDepth));
}

KdTree buildKdTree(const Lattice& lattice, const std::span<const LatticeTriangle> corners,
                   const std::span<const std::uint32_t> triangleIds, const unsigned maxDepth) {
    const auto cellsOf = [margin = referenceMargin(lattice)](const LatticeTriangle& triangle,
                                                             const CellRange& box) {
        return touchedCells(triangle, box, margin);
    };
    return flattened(
        Builder(lattice.resolution, corners, triangleIds, cellsOf, CostSplitter(lattice, maxDepth)));
}

KdTree buildPlannedKdTree(const uvec3 resolution, const CellsOfTriangle& cellsOf,
                          const std::span<const LatticeTriangle> corners,
                          const std::span<const std::uint32_t> triangleIds, const SplitPlan& plan) {
    return flattened(Builder(resolution, corners, triangleIds, cellsOf, PlanSplitter(plan)));
}

} // namespace metamarch
