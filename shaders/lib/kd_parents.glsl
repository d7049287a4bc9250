// SPDX-License-Identifier: MIT
// Loads the kd-tree and, for the way back up, each node's box and parent.
#ifndef METAMARCH_LIB_KD_PARENTS_GLSL
#define METAMARCH_LIB_KD_PARENTS_GLSL
#include "lib/kd_tree.glsl"
#include "shared/kd_parent.h"

WORDS4(kdParentWords, kBindKdParents);

KdParent loadKdParent(const uint nodeId) {
    const uvec4 words = LOAD4(kdParentWords, nodeId);
    return KdParent(words.x, words.y, words.z, words.w);
}
#endif
