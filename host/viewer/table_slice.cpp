// SPDX-License-Identifier: MIT
#include "metamarch/viewer/table_slice.h"

#include <cmath>

namespace metamarch::viewer {

TableSlice tableSlice(const MetaTable& table, const ivec3& cell, const vec3& dir) {
    int across = 0; // the axis that the slice leaves out
    for (const int axis : {1, 2}) {
        across = std::abs(dir[axis]) < std::abs(dir[across]) ? axis : across;
    }
    TableSlice slice{};
    slice.axes = {across == 0 ? 2 : 0, across == 1 ? 2 : 1}; // height goes up where it is in the plane
    slice.brick = cell >> kBrickBits;
    slice.first = slice.brick << kBrickBits;
    slice.first[across] = cell[across];
    slice.isOneWord = !isMixed(table.words[brickEntry(cell, table.resolution)]);
    for (int up = 0; up < TableSlice::kSide; ++up) {
        for (int right = 0; right < TableSlice::kSide; ++right) {
            ivec3 at = slice.first;
            at[slice.axes[0]] += right;
            at[slice.axes[1]] += up;
            const bool isInside = glm::all(glm::lessThan(uvec3(at), table.resolution));
            slice.leaves[static_cast<std::size_t>(up)][static_cast<std::size_t>(right)] =
                isInside ? table.leafAt(at) : TableSlice::kOutside;
        }
    }
    return slice;
}

} // namespace metamarch::viewer
