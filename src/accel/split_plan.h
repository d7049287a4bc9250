// The splits of a kd-tree whose planes lie where the triangles want them, on no lattice: what method 2 and
// the rectilinear table start from.
#pragma once
#include "metamarch/accel/triangle_clip.h"
#include "metamarch/shared/scene_layout.h"

#include <span>
#include <vector>

namespace metamarch {

constexpr unsigned kNoSplit = 3; // in place of an axis: a leaf

struct PlannedNode {
    unsigned axis;
    double plane;        // lattice space
    std::uint32_t above; // the child above the plane; the one below is the next node
};

struct SplitPlan {
    std::vector<PlannedNode> nodes; // depth-first, the root first
    unsigned depth = 0;             // edges on the longest path
};

// Plans the tree over the triangles (in the space of `lattice`, whose planes do not matter) down to
// `maxDepth`
// <= kMaxTreeDepth: the costs of findSplit, here at both ends of what each triangle has in the node. I. Wald,
// V. Havran, "On building fast kd-Trees for Ray Tracing, and on doing that in O(N log N)", IRT 2006, section
// 4.2. Parallel; the plan does not depend on the number of threads.
SplitPlan planSplits(const Lattice& lattice, std::span<const LatticeTriangle> triangles, unsigned maxDepth);

} // namespace metamarch
