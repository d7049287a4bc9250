// SPDX-License-Identifier: MIT
// An axis-aligned box of whole lattice cells.
#pragma once
#include "metamarch/shared/scene_layout.h"

namespace metamarch {

struct CellBox {
    ivec3 lo;
    ivec3 hi; // exclusive
};

inline CellBox boxOf(const Leaf& leaf) { return {unpackCell(leaf.lo), unpackCell(leaf.hi)}; }

} // namespace metamarch
