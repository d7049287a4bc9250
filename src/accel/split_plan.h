// SPDX-License-Identifier: MIT
// The splits of a kd-tree whose planes lie at the ends of the triangles rather than on a lattice. Method 2
// and the rectilinear table start from them.
#pragma once
#include "metamarch/accel/triangle_clip.h"
#include "metamarch/shared/scene_layout.h"

#include <span>
#include <vector>

namespace metamarch {

constexpr unsigned kNoSplit = 3; // value of `axis` that marks a leaf

struct PlannedNode {
    unsigned axis;
    double plane;        // coordinate in lattice space
    std::uint32_t above; // index of the child above the plane; the child below is the next node
};

struct SplitPlan {
    std::vector<PlannedNode> nodes; // depth-first; the root comes first
    unsigned depth = 0;             // number of edges on the longest path from the root to a leaf
};

// Plans the tree over the triangles down to `maxDepth` <= kMaxTreeDepth. The triangles are in the space of
// `lattice`, whose planes are ignored. Costs are those of findSplit, evaluated at both ends of the part of
// each triangle that lies in the node. I. Wald, V. Havran, "On building fast kd-Trees for Ray Tracing, and on
// doing that in O(N log N)", IRT 2006, section 4.2. Runs in parallel; the result does not depend on the
// number of threads.
SplitPlan planSplits(const Lattice& lattice, std::span<const LatticeTriangle> triangles, unsigned maxDepth);

} // namespace metamarch
