// SPDX-License-Identifier: MIT
// The kd-tree. Its split planes are lattice planes, so every leaf is a box of whole cells.
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
    std::vector<KdNode> nodes; // depth-first; the root comes first, and leaves are in the same order
    unsigned depth = 0;        // number of edges on the longest path from the root to a leaf
};

// Returns the depth limit that Pharr & Humphreys suggest, 8 + 1.3 log2(n) (Physically Based Rendering, 2004,
// section 4.5), or kMaxTreeDepth if that is less.
unsigned defaultTreeDepth(std::uint32_t triangleCount);

// Builds the tree down to `maxDepth` <= kMaxTreeDepth. `corners[i]`, in lattice space, belongs to triangle
// `triangleIds[i]`; the ids ascend. Runs in parallel; the result does not depend on the number of threads.
// Throws Error(outOfMemory) if the number of references or nodes exceeds 32 bits.
KdTree buildKdTree(const Lattice& lattice, std::span<const LatticeTriangle> corners,
                   std::span<const std::uint32_t> triangleIds, unsigned maxDepth);

// Does what touchedCells does, for a lattice whose cells may differ in size.
using CellsOfTriangle =
    std::function<std::optional<CellRange>(const LatticeTriangle& triangle, const CellRange& box)>;

// Builds the tree with the splits of `plan`, whose planes are indices of lattice planes. Drops splits that
// rounding has left without effect. Runs in parallel and is deterministic; throws like buildKdTree.
KdTree buildPlannedKdTree(uvec3 resolution, const CellsOfTriangle& cellsOf,
                          std::span<const LatticeTriangle> corners,
                          std::span<const std::uint32_t> triangleIds, const SplitPlan& plan);

} // namespace metamarch
