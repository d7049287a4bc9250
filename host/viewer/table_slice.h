// SPDX-License-Identifier: MIT
// What the meta table says around a cell: a slice through the cell's brick, for a drawing.
#pragma once
#include "metamarch/accel/meta_table.h"

#include <array>
#include <cstdint>

namespace metamarch::viewer {

struct TableSlice {
    static constexpr int kSide = kBrickSide;
    static constexpr std::uint32_t kOutside = 0xffffffffu; // the brick reaches beyond the lattice there

    std::array<int, 2> axes; // those of the lattice that go to the right and up
    ivec3 brick;             // its place among bricks
    ivec3 first;             // the brick's first cell, but on the third axis the slice's cells
    bool isOneWord;          // the table has one word for the whole brick, and not one for each cell
    std::array<std::array<std::uint32_t, kSide>, kSide> leaves; // [up][right]
};

// Returns the slice through `cell` in the plane of the two axes on which `dir` is largest.
TableSlice tableSlice(const MetaTable& table, const ivec3& cell, const vec3& dir);

} // namespace metamarch::viewer
