// SPDX-License-Identifier: MIT
// Merging: joins two leaves that share a face where that does not make rays more expensive.
#pragma once
#include "metamarch/accel/leaf_list.h"

namespace metamarch {

// Joins leaves of `list`, which tile the lattice, for as long as two of them together form a box and cost no
// more as one leaf, by the surface area heuristic. No kd-tree need be able to produce the result. Serial and
// deterministic.
LeafList mergeLeaves(const Lattice& lattice, const LeafList& list);

} // namespace metamarch
