// The meta table: for every cell of the lattice the leaf it belongs to, and how far a ray may go from there.
#pragma once
#include "metamarch/accel/lattice.h"
#include "metamarch/error/error.h"
#include "metamarch/shared/meta_table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// With ErrorKind::outOfMemory: the table takes more bytes than it may.
class TableOverBudget : public Error {
  public:
    explicit TableOverBudget(std::uint64_t budget);
};

struct MetaTable {
    std::vector<Leaf> leaves;              // [leafId], each with its exit box
    uvec3 resolution;                      // cells
    std::vector<std::uint32_t> words;      // shared/meta_table.h
    std::vector<TriangleRecord> triangles; // in the order of its leaves, where these are not the kd-tree's

    // The id of the leaf that holds the cell.
    std::uint32_t leafAt(const ivec3 cell) const {
        const std::uint32_t entry = words[brickEntry(cell, resolution)];
        return isMixed(entry) ? words[cellEntry(entry, cell)] : entry;
    }
};

// The table over leaves that tile a lattice of `resolution` cells. Their boxes are their exit boxes. Bricks
// that hold the same are kept once. Parallel; the same for every number of threads. Throws TableOverBudget.
MetaTable buildMetaTable(uvec3 resolution, std::span<const Leaf> leaves, std::uint64_t budget = kTableBudget);

} // namespace metamarch
