// Tables from which light.h and environment_map.h draw by weight.
#pragma once
#include "metamarch/shading/light/environment.h"
#include "metamarch/shared/light.h"

#include <span>
#include <vector>

namespace metamarch {

// One entry per weight; weights are finite and at least 0. All are drawn alike where every weight is 0. Empty
// for no weights.
std::vector<TableEntry> makeWeightedTable(std::span<const float> weights);

struct EnvironmentTables {
    std::vector<TableEntry> rows;    // [height]
    std::vector<TableEntry> columns; // [height][width]
};

// Draws a texel by the luminance that the bilinearly filtered map has over its area, times its solid angle.
EnvironmentTables makeEnvironmentTables(const Environment& environment);

} // namespace metamarch
