// SPDX-License-Identifier: MIT
// Builds the weighted tables from which light.h and environment_map.h sample.
#pragma once
#include "metamarch/shading/light/environment.h"
#include "metamarch/shared/environment_map.h"

#include <span>
#include <vector>

namespace metamarch {

// Returns one entry per weight; weights are finite and at least 0. If all weights are 0, all entries are
// equally likely. Empty if there are no weights.
std::vector<TableEntry> makeWeightedTable(std::span<const float> weights);

// What environment_map.h samples: see there for weights and cells.
struct EnvironmentTables {
    std::vector<float> weights; // of the texels: [height][width]; 0 or at least 1e-18
    std::uint32_t blockColumnShift = 0;
    std::uint32_t blockRowShift = 0;
    std::vector<TableEntry> blocks;  // [kAnyNormal + 1][kMapBlocks]; `probability` is the factor
    std::vector<TableEntry> rows;    // of cells, by the column of blocks: [kBlocksAcross][height + 1]
    std::vector<TableEntry> columns; // of cells: [height + 1][width]
};

// The weight of a texel is proportional to its brightness above half of the map's mean, times the sine of the
// angle to the pole. All weights of a black map are 0. The map has at least one texel.
EnvironmentTables makeEnvironmentTables(const Environment& environment);

} // namespace metamarch
