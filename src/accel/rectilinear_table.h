// The rectilinear table: any kd-tree's planes as they are, and a meta table over the uneven cells between
// them.
#pragma once
#include "metamarch/accel/meta_table.h"
#include "metamarch/accel/rectilinear_planes.h"

#include <span>

namespace metamarch {

struct RectilinearTable {
    RectilinearPlanes planes;
    MetaTable table;     // with triangles of its own
    unsigned depth;      // of the tree that the leaves come from
    double buildSeconds; // wall time
};

// How deep the tree may be whose planes are taken.
struct RectilinearDepth {
    unsigned limit; // <= kMaxTreeDepth
    bool isWanted;  // or else less will do: the deepest with at most kMostAutomaticCells
};

// Builds the tree over `triangles` in the box of `lattice` with its planes at the triangles' ends, rounded to
// single precision, and the table. Parallel; the same for every number of threads. Throws Error(outOfMemory),
// naming the size and the deepest tree that fits, where a wanted depth takes more than kMaxLatticeResolution
// cells on an axis or a table over kTableBudget.
RectilinearTable buildRectilinearTable(const Lattice& lattice, std::span<const TriangleRecord> triangles,
                                       RectilinearDepth depth, bool exitBoxes);

} // namespace metamarch
