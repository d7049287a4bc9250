// SPDX-License-Identifier: MIT
// Links over a finished kd-tree, for traversals that climb it (parents) or follow ropes.
#pragma once
#include "metamarch/accel/kd_tree.h"
#include "metamarch/shared/kd_parent.h"

#include <cstdint>
#include <vector>

namespace metamarch {

// Returns box and parent of every node, indexed by nodeId.
std::vector<KdParent> linkParents(const Lattice& lattice, const KdTree& tree);

// Returns, indexed by ropeIndex(leafId, axis, above), the smallest node that holds everything behind that
// face of the leaf, or kNoRope at the faces of the lattice. S. Popov, J. Guenther, H.-P. Seidel, P.
// Slusallek, "Stackless KD-Tree Traversal for High Performance GPU Ray Tracing", Eurographics 2007, section
// 4.
std::vector<std::uint32_t> tieRopes(const KdTree& tree);

} // namespace metamarch
