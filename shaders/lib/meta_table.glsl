// SPDX-License-Identifier: MIT
// Loads the meta table and its leaves.
#ifndef METAMARCH_LIB_META_TABLE_GLSL
#define METAMARCH_LIB_META_TABLE_GLSL
#include "lib/leaves.glsl"
#include "shared/meta_table.h"

WORDS1(metaTableWords, kBindTable);

// Returns the id of the leaf that contains the cell.
uint leafAt(const ivec3 cell, const uvec3 resolution) {
    uint entry = LOAD1(metaTableWords, brickEntry(cell, resolution));
    if (isMixed(entry)) {
        entry = LOAD1(metaTableWords, cellEntry(entry, cell));
    }
    return entry;
}

Leaf loadLeafAt(const ivec3 cell, const uvec3 resolution) { return loadLeaf(leafAt(cell, resolution)); }
#endif
