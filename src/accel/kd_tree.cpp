#include "accel/kd_tree.h"

#include "accel/lattice.h"
#include "accel/split.h"
#include "error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace metamarch {
namespace {

using References = std::vector<TriangleReference>;

// References of one task; a node with fewer is built by one thread.
constexpr std::size_t kChunk = 1u << 13u;

struct BuildNode {
    CellRange box;
    unsigned axis = 0;
    std::uint16_t plane = 0;
    std::unique_ptr<BuildNode> below; // both or none
    std::unique_ptr<BuildNode> above;
    std::vector<std::uint32_t> triangleIds; // of a leaf
};

struct Children {
    References below;
    References above;
};

class Builder {
  public:
    Builder(const Lattice& lattice, std::span<const LatticeTriangle> triangles,
            std::span<const std::uint32_t> triangleIds, unsigned depthLimit)
        : corners(triangles), ids(triangleIds), maxDepth(depthLimit), margin(referenceMargin(lattice)),
          cellSize(1.0 / glm::dvec3(lattice.cellsPerUnit)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            root.lo[axis] = 0;
            root.hi[axis] = static_cast<std::uint16_t>(lattice.resolution[static_cast<int>(axis)] - 1);
        }
    }

    std::unique_ptr<BuildNode> build() const {
        References references(corners.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners.size(), kChunk), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                // In a box of the whole lattice something of every triangle remains.
                references[i] = {static_cast<std::uint32_t>(i), *touchedCells(corners[i], root, margin)};
            }
        });
        return buildNode(root, std::move(references), 0);
    }

  private:
    std::unique_ptr<BuildNode> buildNode(const CellRange& box, References references,
                                         const unsigned depth) const {
        auto node = std::make_unique<BuildNode>();
        node->box = box;
        const std::optional<Split> split =
            references.empty() || depth == maxDepth ? std::nullopt : findSplit(references, box, cellSize);
        if (!split || split->cost >= leafCost(references.size())) {
            node->triangleIds.reserve(references.size());
            for (const TriangleReference& reference : references) {
                node->triangleIds.push_back(ids[reference.triangleId]);
            }
            return node;
        }

        node->axis = split->axis;
        node->plane = split->plane;
        CellRange boxBelow = box;
        CellRange boxAbove = box;
        boxBelow.hi[split->axis] = static_cast<std::uint16_t>(split->plane - 1);
        boxAbove.lo[split->axis] = split->plane;
        Children children = distribute(references, *split, boxBelow, boxAbove);
        const bool parallel = references.size() > kChunk;
        References().swap(references); // the two halves need the memory

        if (parallel) {
            tbb::task_group tasks;
            tasks.run([&] { node->below = buildNode(boxBelow, std::move(children.below), depth + 1); });
            node->above = buildNode(boxAbove, std::move(children.above), depth + 1);
            tasks.wait();
        } else {
            node->below = buildNode(boxBelow, std::move(children.below), depth + 1);
            node->above = buildNode(boxAbove, std::move(children.above), depth + 1);
        }
        return node;
    }

    // Hands the references down in order, chunk by chunk, so that the result does not depend on the threads.
    Children distribute(const References& references, const Split& split, const CellRange& boxBelow,
                        const CellRange& boxAbove) const {
        const std::size_t chunkCount = (references.size() + kChunk - 1) / kChunk;
        std::vector<Children> chunks(chunkCount);
        tbb::parallel_for(std::size_t{0}, chunkCount, [&](const std::size_t chunk) {
            const std::size_t end = std::min(references.size(), (chunk + 1) * kChunk);
            for (std::size_t i = chunk * kChunk; i < end; ++i) {
                hand(references[i], split, boxBelow, boxAbove, chunks[chunk]);
            }
        });
        Children children = std::move(chunks.front());
        for (std::size_t i = 1; i < chunkCount; ++i) {
            children.below.insert(children.below.end(), chunks[i].below.begin(), chunks[i].below.end());
            children.above.insert(children.above.end(), chunks[i].above.begin(), chunks[i].above.end());
        }
        return children;
    }

    void hand(const TriangleReference& reference, const Split& split, const CellRange& boxBelow,
              const CellRange& boxAbove, Children& children) const {
        if (reference.cells.hi[split.axis] < split.plane) {
            children.below.push_back(reference);
        } else if (reference.cells.lo[split.axis] >= split.plane) {
            children.above.push_back(reference);
        } else {
            const LatticeTriangle& triangle = corners[reference.triangleId];
            if (const auto cells = touchedCells(triangle, boxBelow, margin)) {
                children.below.push_back({reference.triangleId, *cells});
            }
            if (const auto cells = touchedCells(triangle, boxAbove, margin)) {
                children.above.push_back({reference.triangleId, *cells});
            }
        }
    }

    std::span<const LatticeTriangle> corners;
    std::span<const std::uint32_t> ids;
    unsigned maxDepth;
    glm::dvec3 margin;
    glm::dvec3 cellSize;
    CellRange root{};
};

glm::uvec3 toCell(const CellCorner& corner) { return {corner[0], corner[1], corner[2]}; }

void refuseOver32Bits(const std::size_t count, const char* what) {
    if (count >= (std::size_t{1} << 30u)) {
        throw Error(ExitCode::outOfMemory, std::string("the kd-tree has more than 2^30 ") + what +
                                               "; choose a smaller --tree-depth or --cells");
    }
}

// Depth-first into the flat arrays. Recursion goes kMaxTreeDepth deep at most.
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

} // namespace

unsigned defaultTreeDepth(const std::uint32_t triangleCount) {
    const double depth = 8.0 + 1.3 * std::log2(std::max(triangleCount, 1u));
    return std::min(static_cast<unsigned>(std::lround(depth)), static_cast<unsigned>(kMaxTreeDepth));
}

KdTree buildKdTree(const Lattice& lattice, const std::span<const LatticeTriangle> corners,
                   const std::span<const std::uint32_t> triangleIds, const unsigned maxDepth) {
    const std::unique_ptr<BuildNode> root = Builder(lattice, corners, triangleIds, maxDepth).build();
    KdTree tree;
    flatten(*root, 0, tree);
    return tree;
}

} // namespace metamarch
