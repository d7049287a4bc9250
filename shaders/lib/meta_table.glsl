// The meta table and its leaves.
#ifndef METAMARCH_LIB_META_TABLE_GLSL
#define METAMARCH_LIB_META_TABLE_GLSL
#include "lib/leaves.glsl"

WORDS1(leafOfCell, kBindTable);
#endif
