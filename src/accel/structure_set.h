// SPDX-License-Identifier: MIT
// All structures that traversals walk, over one scene. Each is built when it is first used.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/bvh.h"
#include "metamarch/accel/kd_links.h"
#include "metamarch/accel/rectilinear_table.h"
#include "metamarch/accel/uniform_grid.h"
#include "metamarch/accel/wide_bvh.h"

#include <tbb/collaborative_call_once.h>

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

namespace metamarch {

// Any thread may use it at any time. References are valid as long as the set exists.
class StructureSet {
  public:
    using Triangles = std::vector<TriangleRecord>;

    // A value that the first call makes with `make` from the values of `inputs`. A call throws what `make`
    // throws.
    template <class T>
    class Lazy {
      public:
        template <class Make, class... Inputs>
        explicit Lazy(Make make, const Lazy<Inputs>&... inputs)
            : build([this, make, &inputs...] { timed(make, inputs()...); }) {}

        // Not inlined into the loops of src/reference, which inline everything else.
        [[gnu::noinline]] const T& operator()() const {
            tbb::collaborative_call_once(once, build);
            return *value;
        }

        // Returns the wall time of the build, without that of `inputs`.
        double seconds() const {
            (*this)();
            return buildSeconds;
        }

      private:
        template <class Make, class... Inputs>
        void timed(const Make& make, const Inputs&... inputs) const {
            const auto start = std::chrono::steady_clock::now();
            value = make(inputs...);
            buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        }

        std::function<void()> build;
        mutable tbb::collaborative_once_flag once;
        mutable std::optional<T> value;
        mutable double buildSeconds = 0.0;
    };

    // `usedStructure` must outlive the set.
    explicit StructureSet(const AccelerationStructure& usedStructure) : structure(usedStructure) {}

    const AccelerationStructure& kdTree() const { return structure; }

    // Each triangle once, with ascending ids.
    const Lazy<Triangles> triangles{[this] { return uniqueTriangles(structure.triangles); }};
    // Each triangle once, in the order of the kd-tree's leaves, so that neighbours in space are neighbours
    // here.
    const Lazy<Triangles> spatialTriangles{[this] { return firstOccurrences(structure.triangles); }};

    const Lazy<std::vector<KdParent>> kdParents{
        [this] { return linkParents(structure.lattice, structure.tree); }};
    const Lazy<std::vector<std::uint32_t>> kdRopes{[this] { return tieRopes(structure.tree); }};
    const Lazy<Bvh> bvh{[this](const Triangles& records) { return buildBvh(structure.lattice, records); },
                        triangles};
    const Lazy<std::vector<WideBvhNode>> wideBvh{[](const Bvh& binary) { return widen(binary); }, bvh};
    const Lazy<UniformGrid> uniformGrid{
        [this](const Triangles& records) { return buildUniformGrid(structure.lattice, records); }, triangles};
    const Lazy<RectilinearTable> rectilinearTable{
        [this](const Triangles& records) { return makeRectilinearTable(records); }, triangles};

  private:
    static Triangles uniqueTriangles(Triangles records);
    static Triangles firstOccurrences(const Triangles& records);
    RectilinearTable makeRectilinearTable(const Triangles& records) const;

    const AccelerationStructure& structure;
};

} // namespace metamarch
