// SPDX-License-Identifier: MIT
// The uniform grid: every cell lists the triangles near it.
#pragma once
#include "metamarch/accel/lattice.h"
#include "metamarch/shared/grid_walk.h"

#include <span>
#include <vector>

namespace metamarch {

struct UniformGrid {
    Grid grid;
    std::vector<GridCell> cells;           // indexed by cellIndex
    std::vector<TriangleRecord> triangles; // one copy per reference, cell by cell; ids ascend within a cell
};

// Builds the grid over `triangles` in the box of `lattice`. Runs in parallel and is deterministic. Throws
// Error(outOfMemory) for more than 2^30 references.
UniformGrid buildUniformGrid(const Lattice& lattice, std::span<const TriangleRecord> triangles);

} // namespace metamarch
