// SPDX-License-Identifier: MIT
// Everything that tracing a scene needs: the lattice, the kd-tree, the meta table and the triangle records.
#pragma once
#include "metamarch/accel/gcd_lattice.h"
#include "metamarch/accel/kd_tree.h"
#include "metamarch/accel/lattice.h"
#include "metamarch/accel/meta_table.h"
#include "metamarch/geometry/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

struct AccelerationStructure {
    AccelerationOptions options; // the options it was built with
    Lattice lattice;
    glm::dvec3 unit;                       // LatticeChoice::unit
    std::optional<PlaneRounding> rounding; // set only for TableMethod::gcd
    KdTree tree;
    MetaTable table;
    std::vector<TriangleRecord> triangles; // one per entry of tree.leafTriangles, in that order
    std::uint32_t degenerateTriangles = 0; // number of degenerate triangles in the mesh; they lie in no leaf
    double treeSeconds = 0.0;              // wall-clock seconds
    double tableSeconds = 0.0;
};

// Builds all of it. Throws whatever makeLattice, makeGcdLattice and buildKdTree throw, and
// Error(invalidArgument) if the depth exceeds kMaxTreeDepth.
AccelerationStructure buildAccelerationStructure(const TriangleMesh& mesh,
                                                 const AccelerationOptions& options);

// Returns the records of `triangleIds`, in the same order.
std::vector<TriangleRecord> makeTriangleRecords(const TriangleMesh& mesh,
                                                const std::vector<std::uint32_t>& triangleIds);

// Returns the ids, ascending, of the triangles that a ray can hit: those whose normal is not zero in single
// precision.
std::vector<std::uint32_t> nonDegenerateTriangles(const TriangleMesh& mesh);

} // namespace metamarch
