// SPDX-License-Identifier: MIT
// The user's choices for the tree and the table.
#pragma once
#include "metamarch/accel/partition.h"

#include <cstdint>
#include <optional>

namespace metamarch {

// How the table gets its cells.
enum class TableMethod {
    unit,        // method 1 of the paper: the unit length first, then split planes at its multiples
    gcd,         // method 2 of the paper: the planes first, then their greatest common divisor
    rectilinear, // the planes unchanged: a lattice of uneven cells, beside the kd-tree of method 1
};

struct AccelerationOptions {
    std::optional<glm::dvec3> unit;     // unit length of the lattice per axis, scene units; > 0
    std::optional<std::uint64_t> cells; // approximate number of cells, if no unit is given
    std::optional<unsigned> treeDepth;  // range 0..kMaxTreeDepth
    TableMethod table = TableMethod::unit;
    std::optional<double> quantum{}; // for TableMethod::gcd, scene units; > 0
    bool exitBoxes = true;           // if false, a ray leaves each leaf through the leaf's own box
    bool mergeLeaves = false;        // merges the leaves of the table, not those of the kd-tree
    // Replaces the kd-tree's leaves in the march and gives the resolution.
    std::optional<Partition> partition{};
};

// The paper's kd-tree depth. The paper has no exit boxes.
inline constexpr unsigned kPaperTreeDepth = 16;

} // namespace metamarch
