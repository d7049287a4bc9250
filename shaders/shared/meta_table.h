// SPDX-License-Identifier: MIT
// The memory layout of the meta table. It has two levels, so that its size grows with the area of the leaves'
// faces and not with the volume of the lattice.
//
// The array begins with one word for each brick of kBrickSide^3 cells, in the order of cellIndex. If one leaf
// contains the whole brick, the word names it. Otherwise it is kMixed plus the index in the same array at
// which the brick's cells begin; these have one word each, which names the cell's leaf. If the resolution is
// not a multiple of kBrickSide, the last bricks extend beyond the lattice.
//
// Even cells name a leaf by the first entry of its record (shared/reference_box.h), uneven cells by its id.
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

// Returns the index of the word of the cell's brick.
SHARED_FN uint brickEntry(const ivec3 cell, const uvec3 resolution) {
    return cellIndex(ivec3(cell.x >> kBrickBits, cell.y >> kBrickBits, cell.z >> kBrickBits),
                     bricksAlong(resolution));
}

SHARED_FN bool isMixed(const uint entry) { return entry >= kMixed; }

// Returns the index of the cell's word in a mixed brick. `entry` is the brick's word.
SHARED_FN uint cellEntry(const uint entry, const ivec3 cell) {
    const uint inside = kBrickSide - 1u;
    return (entry - kMixed) + (((uint(cell.z) & inside) << (2 * kBrickBits)) |
                               ((uint(cell.y) & inside) << kBrickBits) | (uint(cell.x) & inside));
}

SHARED_END
#endif
