// SPDX-License-Identifier: MIT
// Partitions that no kd-tree can produce: every plane cuts one of their boxes.
#pragma once
#include "metamarch/accel/partition.h"

#include <cstdint>

namespace metamarch::tests {

// Returns the five boxes of the paper's figure 11 in `box`, arranged around `axis`. `innerLo` and `innerHi`
// are the box in the middle; on the two other axes it lies strictly inside.
std::vector<CellBox> flatPinwheel(const CellBox& box, int axis, ivec3 innerLo, ivec3 innerHi);

// Returns three beams, one along each axis, and the two corners that they leave. `middle` lies strictly
// inside.
std::vector<CellBox> solidPinwheel(const CellBox& box, ivec3 middle);

// Nests pinwheels of both kinds at random places until no box has more than `mostCells` cells or can be
// divided further. Deterministic.
Partition nestedPinwheels(uvec3 resolution, int mostCells, std::uint32_t seed);

} // namespace metamarch::tests
