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
    std::vector<Leaf> leaves; // indexed by leafId; each holds its exit box
    uvec3 resolution;         // cells per axis
    // Layout: shared/meta_table.h, with the ids of leaves.
    std::vector<std::uint32_t> words;
    // Even cells have each triangle once, uneven cells one for each reference, in the order of leaves.
    std::vector<TriangleRecord> triangles;
    // What the march reads over even cells: records of leaves (shared/reference_box.h), and `words` with the
    // first entries of these records in place of ids.
    std::vector<std::uint32_t> leafRecords;
    std::vector<std::uint32_t> recordWords;

    // Returns the id of the leaf that holds the cell.
    std::uint32_t leafAt(const ivec3 cell) const { return lookUp(words, cell); }

    // Returns the first entry of the record of the leaf that holds the cell.
    std::uint32_t recordAt(const ivec3 cell) const { return lookUp(recordWords, cell); }

  private:
    std::uint32_t lookUp(const std::vector<std::uint32_t>& from, const ivec3 cell) const {
        const std::uint32_t entry = from[brickEntry(cell, resolution)];
        return isMixed(entry) ? from[cellEntry(entry, cell)] : entry;
    }
};

// Builds the table over leaves that tile a lattice of `resolution` cells. Each leaf's exit box is its own
// box. Bricks with equal contents are stored once. Runs in parallel; the result does not depend on the number
// of threads. Throws TableOverBudget.
MetaTable buildMetaTable(uvec3 resolution, std::span<const Leaf> leaves, std::uint64_t budget = kTableBudget);

} // namespace metamarch
