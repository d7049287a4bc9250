// SPDX-License-Identifier: MIT
// The meta table's memory: two levels, so that its size follows the leaves' faces and not the lattice's
// volume.
//
// The first words have an entry for each brick of kBrickSide^3 cells, in the order of cellIndex: the id of
// the one leaf that holds all of it, or kMixed and where in the same array the brick's cells begin, each with
// the id of its leaf. Bricks stick out of the lattice where its resolution is no multiple of their side.
#ifndef METAMARCH_SHARED_META_TABLE_H
#define METAMARCH_SHARED_META_TABLE_H
#include "scene_layout.h"

SHARED_BEGIN

const int kBrickBits = 3;
const uint kBrickSide = 1u << kBrickBits;
const uint kBrickCells = kBrickSide * kBrickSide * kBrickSide;
const uint kMixed = 0x80000000u;

SHARED_FN uvec3 bricksAlong(const uvec3 resolution) {
    return uvec3((resolution.x + kBrickSide - 1u) >> kBrickBits,
                 (resolution.y + kBrickSide - 1u) >> kBrickBits,
                 (resolution.z + kBrickSide - 1u) >> kBrickBits);
}

// Where the entry of the cell's brick is.
SHARED_FN uint brickEntry(const ivec3 cell, const uvec3 resolution) {
    return cellIndex(ivec3(cell.x >> kBrickBits, cell.y >> kBrickBits, cell.z >> kBrickBits),
                     bricksAlong(resolution));
}

SHARED_FN bool isMixed(const uint entry) { return entry >= kMixed; }

// Where a mixed brick's word for the cell is.
SHARED_FN uint cellEntry(const uint entry, const ivec3 cell) {
    const uint inside = kBrickSide - 1u;
    return (entry - kMixed) + (((uint(cell.z) & inside) << (2 * kBrickBits)) |
                               ((uint(cell.y) & inside) << kBrickBits) | (uint(cell.x) & inside));
}

SHARED_END
#endif
