// SPDX-License-Identifier: MIT
// Loads the kd-tree and its ropes, which lead to the node behind each face of each leaf.
#ifndef METAMARCH_LIB_KD_ROPES_GLSL
#define METAMARCH_LIB_KD_ROPES_GLSL
#include "lib/kd_tree.glsl"
#include "shared/kd_rope.h"

WORDS1(kdRopes, kBindKdRopes);
#endif
