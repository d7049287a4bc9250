// SPDX-License-Identifier: MIT
// Partitions: boxes of whole cells that tile the lattice, whether or not a kd-tree could produce them. Seo,
// Kang, Yang, "An Effective Ray Tracing Algorithm Using a Meta Table", section 5 and figure 11.
#pragma once
#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/leaf_list.h"
#include "metamarch/accel/triangle_clip.h"

#include <span>
#include <vector>

namespace metamarch {

// Boxes that the user supplies for the march in place of the kd-tree's leaves.
struct Partition {
    uvec3 resolution; // cells per axis of the lattice; 1..kMaxLatticeResolution
    std::vector<CellBox> boxes;
};

// Throws Error(inputRefused), naming the boxes and a cell, if a box is empty, leaves the lattice or overlaps
// another box, or if a cell lies in no box.
void checkTiling(const Partition& partition);

// Makes a leaf of each box and lists in it the triangles that come within kReferenceMargin. The boxes must
// tile the lattice. `corners[i]`, in lattice space, belongs to triangle `triangleIds[i]`; the ids ascend.
// Runs in parallel; the result does not depend on the number of threads. Throws Error(outOfMemory) for 2^30
// references or more.
LeafList listTriangles(const Lattice& lattice, std::span<const CellBox> boxes,
                       std::span<const LatticeTriangle> corners, std::span<const std::uint32_t> triangleIds);

// Checks lists that something other than listTriangles made. Throws Error(inputRefused), naming box and
// triangle, if a box lacks a triangle that listTriangles would list. Extra triangles do no harm.
void checkListing(const Lattice& lattice, const LeafList& list, std::span<const LatticeTriangle> corners,
                  std::span<const std::uint32_t> triangleIds);

} // namespace metamarch
