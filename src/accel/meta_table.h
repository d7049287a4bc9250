// SPDX-License-Identifier: MIT
// The meta table: for every cell of the lattice, the leaf it belongs to and how far a ray may advance from
// there.
#pragma once
#include "metamarch/accel/lattice.h"
#include "metamarch/error/error.h"
#include "metamarch/shared/meta_table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// The table would exceed its budget in bytes. The kind is ErrorKind::outOfMemory.
class TableOverBudget : public Error {
  public:
    explicit TableOverBudget(std::uint64_t budget);
};

struct MetaTable {
    std::vector<Leaf> leaves;         // indexed by leafId; each holds its exit box
    uvec3 resolution;                 // cells per axis
    std::vector<std::uint32_t> words; // layout: shared/meta_table.h
    // The triangle records in the order of the table's leaves; empty if these are the kd-tree's leaves.
    std::vector<TriangleRecord> triangles;
    // The leaves again, with the boxes of their references: the array of shared/reference_box.h. Uneven cells
    // have none.
    std::vector<std::uint32_t> framedLeaves;

    // Returns the id of the leaf that holds the cell.
    std::uint32_t leafAt(const ivec3 cell) const {
        const std::uint32_t entry = words[brickEntry(cell, resolution)];
        return isMixed(entry) ? words[cellEntry(entry, cell)] : entry;
    }
};

// Builds the table over leaves that tile a lattice of `resolution` cells. Each leaf's exit box is its own
// box. Bricks with equal contents are stored once. Runs in parallel; the result does not depend on the number
// of threads. Throws TableOverBudget.
MetaTable buildMetaTable(uvec3 resolution, std::span<const Leaf> leaves, std::uint64_t budget = kTableBudget);

} // namespace metamarch
