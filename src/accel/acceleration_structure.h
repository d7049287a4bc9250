// Everything rays need of a scene: lattice, kd-tree, meta table and the triangle records in leaf order.
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
    AccelerationOptions options; // it was built by
    Lattice lattice;
    glm::dvec3 unit;                       // LatticeChoice::unit
    std::optional<PlaneRounding> rounding; // of method 2
    KdTree tree;
    MetaTable table;
    std::vector<TriangleRecord> triangles; // one per entry of tree.leafTriangles

    // In the order of the table's leaves.
    std::span<const TriangleRecord> tableTriangles() const {
        return table.triangles.empty() ? triangles : table.triangles;
    }

    std::uint32_t degenerateTriangles = 0; // of the mesh, in no leaf
    double treeSeconds = 0.0;              // wall time
    double tableSeconds = 0.0;
};

// Throws what makeLattice, makeGcdLattice and buildKdTree throw; Error(invalidArgument) for a depth over
// kMaxTreeDepth.
AccelerationStructure buildAccelerationStructure(const TriangleMesh& mesh,
                                                 const AccelerationOptions& options);

// The records of `triangleIds`, in their order.
std::vector<TriangleRecord> makeTriangleRecords(const TriangleMesh& mesh,
                                                const std::vector<std::uint32_t>& triangleIds);

// Ids of the triangles that have a normal in single precision, ascending: those that rays can meet.
std::vector<std::uint32_t> solidTriangles(const TriangleMesh& mesh);

} // namespace metamarch
