// SPDX-License-Identifier: MIT
// Small boxes around the triangles of a leaf, which a ray meets before it tests the triangles themselves.
#pragma once
#include "metamarch/shared/scene_layout.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// Returns the array of shared/reference_box.h for `leaves`, whose boxes are their exit boxes. `triangles` are
// the records in leaf order. Runs in parallel; the result does not depend on the number of threads.
std::vector<std::uint32_t> frameLeaves(const Lattice& lattice, std::span<const Leaf> leaves,
                                       std::span<const TriangleRecord> triangles);

} // namespace metamarch
