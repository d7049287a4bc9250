// SPDX-License-Identifier: MIT
// The bounding volume hierarchy (BVH): a binary tree of boxes in which each triangle lies in exactly one
// leaf.
#pragma once
#include "metamarch/shared/bvh_node.h"

#include <span>
#include <vector>

namespace metamarch {

struct Bvh {
    std::vector<BvhNode> nodes;            // depth-first; the root comes first
    std::vector<TriangleRecord> triangles; // in leaf order
    unsigned depth = 0;                    // number of edges on the longest path from the root to a leaf
};

// Builds a BVH over `triangles`; its boxes are in the space of `lattice`. I. Wald, "On fast Construction of
// SAH-based Bounding Volume Hierarchies", IRT 2007. Runs in parallel; the result does not depend on the
// number of threads. Throws Error(outOfMemory) for more than kMaxBvhTriangles triangles.
Bvh buildBvh(const Lattice& lattice, std::span<const TriangleRecord> triangles);

} // namespace metamarch
