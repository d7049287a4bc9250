// SPDX-License-Identifier: MIT
// The wide bounding volume hierarchy: nodes of up to four children, whose boxes take a byte a plane.
#pragma once
#include "metamarch/accel/bvh.h"
#include "metamarch/shared/wide_bvh_node.h"

#include <vector>

namespace metamarch {

// Joins the nodes of `bvh`: a wide node's children are those of a binary node, of which the inner child with
// the largest box is opened until there are four. The leaves, and the order of the triangles, are those of
// `bvh`. Nodes are depth-first; the root comes first. I. Wald, C. Benthin, S. Boulos, "Getting Rid of
// Packets", IRT 2008, for the collapse. Throws Error(outOfMemory) if an id would not fit into wideRest.
std::vector<WideBvhNode> widen(const Bvh& bvh);

} // namespace metamarch
