// The bounding volume hierarchy: a binary tree of boxes, each triangle in one leaf.
#pragma once
#include "metamarch/shared/bvh_node.h"

#include <span>
#include <vector>

namespace metamarch {

struct Bvh {
    std::vector<BvhNode> nodes;            // depth-first, the root first
    std::vector<TriangleRecord> triangles; // leaf by leaf
    unsigned depth = 0;                    // edges on the longest path
};

// Builds the tree over `triangles`, boxes in the space of `lattice`: I. Wald, "On fast Construction of
// SAH-based Bounding Volume Hierarchies", IRT 2007. Parallel; the tree does not depend on the number of
// threads. Throws Error(outOfMemory) for more than kMaxBvhTriangles.
Bvh buildBvh(const Lattice& lattice, std::span<const TriangleRecord> triangles);

} // namespace metamarch
