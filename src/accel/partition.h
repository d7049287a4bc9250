// Partitions: any boxes of whole cells that tile the lattice, whether a kd-tree could make them or not.
// Seo, Kang, Yang, "An Effective Ray Tracing Algorithm Using a Meta Table", section 5 and figure 11.
#pragma once
#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/leaf_list.h"
#include "metamarch/accel/triangle_clip.h"

#include <span>
#include <vector>

namespace metamarch {

// What a user may march in place of the kd-tree's leaves.
struct Partition {
    uvec3 resolution; // of the lattice; 1..kMaxLatticeResolution
    std::vector<CellBox> boxes;
};

// Throws Error(inputRefused), naming boxes and a cell, where a box holds no cell, leaves the lattice or
// overlaps another, or where no box holds a cell.
void checkTiling(const Partition& partition);

// The boxes, which tile the lattice, each with the triangles that come within kReferenceMargin of it
// (`corners[i]` in lattice space belongs to `triangleIds[i]`, ascending). Parallel; the same for every number
// of threads. Throws Error(outOfMemory) for 2^30 references.
LeafList listTriangles(const Lattice& lattice, std::span<const CellBox> boxes,
                       std::span<const LatticeTriangle> corners, std::span<const std::uint32_t> triangleIds);

// For lists that were made otherwise: throws Error(inputRefused), naming both, where a box does not list a
// triangle that listTriangles would. One too many does no harm.
void checkListing(const Lattice& lattice, const LeafList& list, std::span<const LatticeTriangle> corners,
                  std::span<const std::uint32_t> triangleIds);

} // namespace metamarch
