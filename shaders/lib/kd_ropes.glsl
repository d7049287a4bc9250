// SPDX-License-Identifier: MIT
// The kd-tree with ropes: what lies behind each face of each leaf.
#ifndef METAMARCH_LIB_KD_ROPES_GLSL
#define METAMARCH_LIB_KD_ROPES_GLSL
#include "lib/kd_tree.glsl"
#include "shared/kd_rope.h"

WORDS1(kdRopes, kBindKdRopes);
#endif
