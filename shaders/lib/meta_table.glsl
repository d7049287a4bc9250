// The meta table and its leaves.
#ifndef METAMARCH_LIB_META_TABLE_GLSL
#define METAMARCH_LIB_META_TABLE_GLSL
#include "lib/leaves.glsl"

WORDS1(leafOfCell, kBindTable);

// The leaf that holds `cell` of the lattice.
uint leafAt(const ivec3 cell) { return LOAD1(leafOfCell, cellIndex(cell, lattice.resolution)); }
#endif
