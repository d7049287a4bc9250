// SPDX-License-Identifier: MIT
// Reads a user's partition from a file:
//   {"resolution": [3, 3, 1], "boxes": [[0, 0, 0, 2, 1, 1], ...]}
// `resolution` is the number of cells along x, y and z. A box is its first cell and the cell behind its last
// one.
#pragma once
#include "metamarch/accel/partition.h"

#include <filesystem>

namespace metamarch {

// Throws Error(inputRefused), "<path>: <what>", if the file cannot be read, is not JSON of this form, or its
// boxes do not tile the lattice; Error(outOfMemory) if the table would exceed kTableBudget.
Partition readPartition(const std::filesystem::path& path);

} // namespace metamarch
