// SPDX-License-Identifier: MIT
// Loads the meta table and its leaves.
#ifndef METAMARCH_LIB_META_TABLE_GLSL
#define METAMARCH_LIB_META_TABLE_GLSL
#include "lib/leaves.glsl"
#include "shared/meta_table.h"

WORDS4(metaTableWords, kBindTable);

// Loads four words for one: llvmpipe loads single words by vpgatherdd, which processors that guard against
// "gather data sampling" (Intel, 2023) execute ten times as slowly.
uint loadTableWord(const uint i) {
    const uvec4 words = LOAD4(metaTableWords, i >> 2u);
    const uint lower = (i & 1u) != 0u ? words.y : words.x;
    const uint upper = (i & 1u) != 0u ? words.w : words.z;
    return (i & 2u) != 0u ? upper : lower;
}

// Returns the id of the leaf that contains the cell.
uint leafAt(const ivec3 cell, const uvec3 resolution) {
    uint entry = loadTableWord(brickEntry(cell, resolution));
    if (isMixed(entry)) {
        entry = loadTableWord(cellEntry(entry, cell));
    }
    return entry;
}

#endif
