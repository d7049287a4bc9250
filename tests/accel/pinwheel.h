// Partitions that no kd-tree can make: every plane cuts one of their boxes.
#pragma once
#include "metamarch/accel/partition.h"

#include <cstdint>

namespace metamarch::tests {

// The five boxes of the paper's figure 11, over `box` and around `axis`; `innerLo` and `innerHi` are the box
// in the middle, strictly inside in the two other axes.
std::vector<CellBox> flatPinwheel(const CellBox& box, int axis, ivec3 innerLo, ivec3 innerHi);

// Three beams, one along each axis, and the two corners that they leave; `middle` lies strictly inside.
std::vector<CellBox> solidPinwheel(const CellBox& box, ivec3 middle);

// Pinwheels of both kinds in pinwheels, cut at random places until no box has more than `mostCells`
// cells or can be cut no more. Deterministic.
Partition nestedPinwheels(uvec3 resolution, int mostCells, std::uint32_t seed);

} // namespace metamarch::tests
