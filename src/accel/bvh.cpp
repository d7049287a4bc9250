// SPDX-License-Identifier: MIT
#include "metamarch/accel/bvh.h"

#include "metamarch/accel/triangle_box.h"
#include "metamarch/error/error.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <optional>

namespace metamarch {
namespace {

constexpr int kBins = 32;

// Cost of visiting an inner node, in triangle tests: it takes two box tests and reads 64 bytes.
constexpr double kNodeCost = 1.0;

// A range with fewer triangles is built by one thread.
constexpr std::size_t kSerial = 4096;

struct Primitive {
    Box box; // lattice space, grown by the margin
    glm::dvec3 center;
    std::uint32_t recordIndex; // index into the given triangles
};

struct BuildNode {
    Box box;
    std::size_t first = 0; // index of the first primitive; in the end the primitives are in leaf order
    std::size_t count = 0;
    std::array<std::unique_ptr<BuildNode>, 2> children; // either both or none
};

struct BinnedSplit {
    int axis;
    int bin; // first bin of the second child
    double cost;
};

class Builder {
  public:
    Builder(const Lattice& lattice, std::span<const TriangleRecord> triangles)
        : primitives(triangles.size()), worldPerCell(1.0 / glm::dvec3(lattice.cellsPerUnit)) {
        tbb::parallel_for(std::size_t{0}, triangles.size(), [&](const std::size_t i) {
            const Box box = boxOf(lattice, triangles[i]);
            primitives[i] = {box, 0.5 * (box.lo + box.hi), static_cast<std::uint32_t>(i)};
        });
    }

    std::unique_ptr<BuildNode> build() { return buildNode(0, primitives.size(), 0); }

    std::vector<Primitive> primitives;

  private:
    std::unique_ptr<BuildNode> buildNode(const std::size_t first, const std::size_t count,
                                         const unsigned depth) {
        auto node = std::make_unique<BuildNode>();
        node->first = first;
        node->count = count;
        const std::span<Primitive> range = std::span(primitives).subspan(first, count);
        Box centers;
        for (const Primitive& primitive : range) {
            node->box.grow(primitive.box);
            centers.grow({primitive.center, primitive.center});
        }
        if (count <= 1) {
            return node;
        }
        const std::optional<BinnedSplit> split = findSplit(range, centers, area(node->box));
        const bool fitsLeaf = count <= kMaxBvhLeafTriangles;
        if (fitsLeaf && (depth == kMaxBvhDepth || !split || split->cost >= static_cast<double>(count))) {
            return node;
        }
        // Halving down to the leaves needs this many levels. If a split could leave fewer, halve from here
        // on.
        const bool canSplit =
            split && depth + 1 + static_cast<unsigned>(std::bit_width(count)) < kMaxBvhDepth;
        const std::size_t below = canSplit ? partition(range, centers, *split) : halve(range, centers);

        const auto buildChild = [&](const std::size_t i) {
            node->children[i] = i == 0 ? buildNode(first, below, depth + 1)
                                       : buildNode(first + below, count - below, depth + 1);
        };
        if (count > kSerial) {
            tbb::task_group tasks;
            tasks.run([&] { buildChild(0); });
            buildChild(1);
            tasks.wait();
        } else {
            buildChild(0);
            buildChild(1);
        }
        return node;
    }

    double area(const Box& box) const {
        const glm::dvec3 size = (box.hi - box.lo) * worldPerCell;
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }

    static int binOf(const Primitive& primitive, const Box& centers, const int axis) {
        const double place =
            (primitive.center[axis] - centers.lo[axis]) / (centers.hi[axis] - centers.lo[axis]) * kBins;
        return std::min(static_cast<int>(place), kBins - 1);
    }

    // Returns the cheapest split between bins, or nothing if all centers coincide. Among equal costs the
    // first wins.
    std::optional<BinnedSplit> findSplit(const std::span<const Primitive> range, const Box& centers,
                                         const double nodeArea) const {
        std::optional<BinnedSplit> best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(centers.hi[axis] > centers.lo[axis])) {
                continue;
            }
            std::array<Box, kBins> boxes;
            std::array<std::size_t, kBins> counts{};
            for (const Primitive& primitive : range) {
                const auto bin = static_cast<std::size_t>(binOf(primitive, centers, axis));
                boxes[bin].grow(primitive.box);
                ++counts[bin];
            }
            std::array<double, kBins> costAbove{}; // costs of bins i and above
            Box box;
            std::size_t count = 0;
            for (std::size_t i = kBins - 1; i > 0; --i) {
                box.grow(boxes[i]);
                count += counts[i];
                costAbove[i] = count == 0 ? 0.0 : area(box) * static_cast<double>(count);
            }
            box = {};
            count = 0;
            for (std::size_t i = 1; i < kBins; ++i) {
                box.grow(boxes[i - 1]);
                count += counts[i - 1];
                if (count == 0 || count == range.size()) {
                    continue;
                }
                const double cost =
                    kNodeCost + (area(box) * static_cast<double>(count) + costAbove[i]) / nodeArea;
                if (!best || cost < best->cost) {
                    best = {axis, static_cast<int>(i), cost};
                }
            }
        }
        return best;
    }

    // Both functions return the number of primitives in the first child. They are stable, so the order is
    // deterministic.
    static std::size_t partition(const std::span<Primitive> range, const Box& centers,
                                 const BinnedSplit& split) {
        const auto middle =
            std::stable_partition(range.begin(), range.end(), [&](const Primitive& primitive) {
                return binOf(primitive, centers, split.axis) < split.bin;
            });
        return static_cast<std::size_t>(middle - range.begin());
    }

    static std::size_t halve(const std::span<Primitive> range, const Box& centers) {
        const glm::dvec3 size = centers.hi - centers.lo;
        const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
        std::stable_sort(range.begin(), range.end(), [&](const Primitive& a, const Primitive& b) {
            return a.center[axis] < b.center[axis];
        });
        return range.size() / 2;
    }

    glm::dvec3 worldPerCell;
};

std::uint32_t leafChild(const std::size_t first, const std::size_t count) {
    return kBvhLeaf | static_cast<std::uint32_t>(count) << 27u | static_cast<std::uint32_t>(first);
}

// Appends the nodes to the flat array, depth-first. The recursion is at most kMaxBvhDepth deep.
std::uint32_t flatten(const BuildNode& node, const unsigned depth, Bvh& bvh) {
    bvh.depth = std::max(bvh.depth, depth);
    if (!node.children[0]) {
        return leafChild(node.first, node.count);
    }
    const std::size_t nodeId = bvh.nodes.size();
    bvh.nodes.emplace_back();
    const Box& box0 = node.children[0]->box;
    const Box& box1 = node.children[1]->box;
    const std::uint32_t child0 = flatten(*node.children[0], depth + 1, bvh);
    const std::uint32_t child1 = flatten(*node.children[1], depth + 1, bvh);
    bvh.nodes[nodeId] = {lowCorner(box0), child0, highCorner(box0), child1,
                         lowCorner(box1), 0,      highCorner(box1), 0};
    return static_cast<std::uint32_t>(nodeId);
}

} // namespace

Bvh buildBvh(const Lattice& lattice, const std::span<const TriangleRecord> triangles) {
    if (triangles.size() > kMaxBvhTriangles) {
        throw Error(ErrorKind::outOfMemory, "the BVH holds at most 2^27 triangles");
    }
    Builder builder(lattice, triangles);
    const std::unique_ptr<BuildNode> root = builder.build();
    Bvh bvh;
    if (root->children[0]) {
        flatten(*root, 0, bvh);
    } else {
        // The root is a leaf. Traversals start at an inner node, so add one whose second child is an empty
        // leaf.
        const Box box = triangles.empty() ? Box{glm::dvec3(0.0), glm::dvec3(0.0)} : root->box;
        const vec3 lo = lowCorner(box);
        const vec3 hi = highCorner(box);
        bvh.nodes.push_back({lo, leafChild(0, root->count), hi, leafChild(0, 0), lo, 0, hi, 0});
        bvh.depth = 1;
    }
    bvh.triangles.reserve(triangles.size());
    for (const Primitive& primitive : builder.primitives) {
        bvh.triangles.push_back(triangles[primitive.recordIndex]);
    }
    return bvh;
}

} // namespace metamarch
