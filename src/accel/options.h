// What a user may ask of tree and table.
#pragma once
#include "metamarch/accel/partition.h"

#include <cstdint>
#include <optional>

namespace metamarch {

// How the table comes to its cells.
enum class TableMethod {
    unit,        // the paper's method 1: the unit length first, split planes at its multiples
    gcd,         // its method 2: the planes first, then the greatest common divisor of them
    rectilinear, // the planes as they are: a lattice of uneven cells, beside the tree of method 1
};

struct AccelerationOptions {
    std::optional<glm::dvec3> unit; // unit length of the lattice per axis, in scene units; > 0
    std::optional<std::uint64_t>
        cells; // wanted number of cells, where no unit is given; the lattice has about as many
    std::optional<unsigned> treeDepth; // 0..kMaxTreeDepth
    TableMethod table = TableMethod::unit;
    std::optional<double> quantum{};      // of method 2, in scene units; > 0
    bool exitBoxes = true;                // or a ray leaves each leaf by the leaf's own box
    bool mergeLeaves = false;             // the table's, not the kd-tree's
    std::optional<Partition> partition{}; // marched in place of the kd-tree's leaves; it gives the resolution
};

// The paper's setting: kd-tree depth 16, and no exit boxes.
inline constexpr unsigned kPaperTreeDepth = 16;

} // namespace metamarch
