// SPDX-License-Identifier: MIT
// The rectilinear table: keeps the planes of any kd-tree unchanged and builds a meta table over the uneven
// cells between them.
#pragma once
#include "metamarch/accel/meta_table.h"
#include "metamarch/accel/rectilinear_planes.h"

#include <span>

namespace metamarch {

struct RectilinearTable {
    RectilinearPlanes planes;
    MetaTable table;     // has its own copy of the triangles
    unsigned depth;      // depth of the tree that the leaves come from
    double buildSeconds; // wall-clock seconds
};

// The depth limit of the tree whose planes are used.
struct RectilinearDepth {
    unsigned limit; // at most kMaxTreeDepth
    // The user asked for it; otherwise the depth shrinks until there are at most kMostAutomaticCells cells.
    bool isWanted;
};

// Builds a tree over `triangles` in the box of `lattice`, with planes at the ends of the triangles, rounded
// to single precision, and then the table. Runs in parallel; the result does not depend on the number of
// threads. Throws Error(outOfMemory), naming the size and the deepest tree that fits, if a depth that the
// user asked for needs more than kMaxLatticeResolution cells on an axis or a table over kTableBudget.
RectilinearTable buildRectilinearTable(const Lattice& lattice, std::span<const TriangleRecord> triangles,
                                       RectilinearDepth depth, bool exitBoxes);

} // namespace metamarch
