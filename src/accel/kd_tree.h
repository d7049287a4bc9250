// The kd-tree: built on the lattice, so that every leaf is a box of whole cells.
#pragma once
#include "metamarch/accel/leaf_list.h"
#include "metamarch/accel/split_plan.h"
#include "metamarch/accel/triangle_clip.h"
#include "metamarch/shared/kd_node.h"

#include <functional>
#include <span>
#include <vector>

namespace metamarch {

struct KdTree : LeafList {
    std::vector<KdNode> nodes; // depth-first, the root first; leaves in the same order
    unsigned depth = 0;        // edges on the longest path
};

// The depth limit that Pharr & Humphreys suggest, 8 + 1.3 log2(n) (Physically Based Rendering, 2004,
// section 4.5), at most kMaxTreeDepth.
unsigned defaultTreeDepth(std::uint32_t triangleCount);

// Builds the tree over the triangles (`corners[i]` in lattice space belongs to `triangleIds[i]`, ascending)
// down to `maxDepth` <= kMaxTreeDepth. Parallel; the tree does not depend on the number of threads. Throws
// Error(outOfMemory) where references or nodes pass 32 bits.
KdTree buildKdTree(const Lattice& lattice, std::span<const LatticeTriangle> corners,
                   std::span<const std::uint32_t> triangleIds, unsigned maxDepth);

// touchedCells of a lattice whose cells may differ in size.
using CellsOfTriangle =
    std::function<std::optional<CellRange>(const LatticeTriangle& triangle, const CellRange& box)>;

// Builds the tree with the splits of `plan`, whose planes are lattice planes by their numbers; splits that
// have become empty on the way there are left out. Parallel and deterministic; throws as above.
KdTree buildPlannedKdTree(uvec3 resolution, const CellsOfTriangle& cellsOf,
                          std::span<const LatticeTriangle> corners,
                          std::span<const std::uint32_t> triangleIds, const SplitPlan& plan);

} // namespace metamarch
