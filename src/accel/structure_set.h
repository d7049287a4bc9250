// Every structure that some traversal walks, over one scene; each is built when first asked for.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/bvh.h"
#include "metamarch/accel/rectilinear_table.h"
#include "metamarch/accel/uniform_grid.h"
#include "metamarch/shared/kd_parent.h"

#include <tbb/collaborative_call_once.h>

#include <optional>
#include <vector>

namespace metamarch {

// Any thread may ask at any time. References are good for the life of the set.
class StructureSet {
  public:
    // `kdTree` must outlive the set.
    explicit StructureSet(const AccelerationStructure& kdTree) : accelerationStructure(kdTree) {}

    const AccelerationStructure& kdTree() const { return accelerationStructure; }
    const std::vector<KdParent>& kdParents() const;
    const std::vector<std::uint32_t>& kdRopes() const;
    const Bvh& bvh() const;
    const UniformGrid& uniformGrid() const;
    const RectilinearTable& rectilinearTable() const;     // throws what buildRectilinearTable throws
    const std::vector<TriangleRecord>& triangles() const; // each once, ascending ids
    // Each once, in the order of the kd-tree's leaves: what lies together in space does so here.
    const std::vector<TriangleRecord>& spatialTriangles() const;

  private:
    template <class T>
    struct Lazy {
        tbb::collaborative_once_flag once;
        T value;
    };

    const AccelerationStructure& accelerationStructure;
    mutable Lazy<std::vector<KdParent>> lazyParents;
    mutable Lazy<std::vector<std::uint32_t>> lazyRopes;
    mutable Lazy<Bvh> lazyBvh;
    mutable Lazy<UniformGrid> lazyGrid;
    mutable Lazy<std::optional<RectilinearTable>> lazyRectilinear;
    mutable Lazy<std::vector<TriangleRecord>> lazyTriangles;
    mutable Lazy<std::vector<TriangleRecord>> lazySpatialTriangles;
};

} // namespace metamarch
