// SPDX-License-Identifier: MIT
// Loads the meta table and its leaves.
#ifndef METAMARCH_LIB_META_TABLE_GLSL
#define METAMARCH_LIB_META_TABLE_GLSL
#include "lib/leaves.glsl"
#include "shared/meta_table.h"

WORDS4(metaTableWords, kBindTable);

// Loads four words for one: llvmpipe loads single words by vpgatherdd, which processors that guard against
// "gather data sampling" (Intel, 2023) execute ten times as slowly.
uint loadTableWord(const uint i) { return oneOf(LOAD4(metaTableWords, i >> 2u), i); }

// Returns the word that names the leaf of the cell.
uint wordAt(const ivec3 cell, const uvec3 resolution) {
    uint entry = loadTableWord(brickEntry(cell, resolution));
    if (isMixed(entry)) {
        entry = loadTableWord(cellEntry(entry, cell));
    }
    return entry;
}

#endif
