// SPDX-License-Identifier: MIT
// Small boxes around the triangles of a leaf, which a ray meets before it tests the triangles themselves.
#pragma once
#include "metamarch/accel/meta_table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// The triangles of a list of leaves, each once, in the order of their first references. So triangles that lie
// near each other in space do so in memory.
struct SharedTriangles {
    std::vector<std::uint32_t> ids;
    std::vector<std::uint32_t> indices; // for each reference, the place of its triangle in `ids`
};

// `triangleCount` is above every id.
SharedTriangles shareTriangles(std::span<const std::uint32_t> leafTriangles, std::size_t triangleCount);

// Sets table.leafRecords and table.recordWords. The table's other members are set; the boxes of its leaves
// are their exit boxes. `indices` are those of the records in table.triangles, in leaf order. Runs in
// parallel; the result does not depend on the number of threads.
void recordLeaves(const Lattice& lattice, std::span<const std::uint32_t> indices, MetaTable& table);

} // namespace metamarch
