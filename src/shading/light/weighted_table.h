// SPDX-License-Identifier: MIT
// Builds the weighted tables from which light.h and environment_map.h sample.
#pragma once
#include "metamarch/shading/light/environment.h"
#include "metamarch/shared/light.h"

#include <span>
#include <vector>

namespace metamarch {

// Returns one entry per weight; weights are finite and at least 0. If all weights are 0, all entries are
// equally likely. Empty if there are no weights.
std::vector<TableEntry> makeWeightedTable(std::span<const float> weights);

struct EnvironmentTables {
    std::vector<TableEntry> rows;    // indexed by row: [height]
    std::vector<TableEntry> columns; // indexed by row and column: [height][width]
};

// Samples a texel in proportion to the luminance of the bilinearly filtered map over its area, times its
// solid angle.
EnvironmentTables makeEnvironmentTables(const Environment& environment);

} // namespace metamarch
