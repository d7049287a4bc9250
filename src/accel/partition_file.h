// A user's partition as a file:
//   {"resolution": [3, 3, 1], "boxes": [[0, 0, 0, 2, 1, 1], ...]}
// with the lattice's cells along x, y, z and of each box the first cell and the cell behind the last.
#pragma once
#include "metamarch/accel/partition.h"

#include <filesystem>

namespace metamarch {

// Throws Error(inputRefused), "<path>: <what>", for a file that cannot be read, is no such JSON or whose
// boxes do not tile the lattice, and Error(outOfMemory) for a table over kTableBudget.
Partition readPartition(const std::filesystem::path& path);

} // namespace metamarch
