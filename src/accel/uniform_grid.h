// The uniform grid: every cell lists the triangles near it.
#pragma once
#include "metamarch/accel/lattice.h"
#include "metamarch/shared/grid_walk.h"

#include <span>
#include <vector>

namespace metamarch {

struct UniformGrid {
    Grid grid;
    std::vector<GridCell> cells;           // [cellIndex]
    std::vector<TriangleRecord> triangles; // a copy per reference, cell by cell, ascending ids in each
};

// Builds the grid over `triangles` in the box of `lattice`. Deterministic, parallel. Throws
// Error(outOfMemory) for more than 2^30 references.
UniformGrid buildUniformGrid(const Lattice& lattice, std::span<const TriangleRecord> triangles);

} // namespace metamarch
