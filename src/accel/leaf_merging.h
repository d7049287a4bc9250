// Merging: two leaves that lie face to face become one where that costs a ray no more.
#pragma once
#include "metamarch/accel/leaf_list.h"

namespace metamarch {

// Joins leaves of `list`, which tile the lattice, as long as two of them form a box and, by the surface area
// heuristic, cost no more as one. What is left need not come from any kd-tree. Serial, and always the same.
LeafList mergeLeaves(const Lattice& lattice, const LeafList& list);

} // namespace metamarch
