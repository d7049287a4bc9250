// SPDX-License-Identifier: MIT
// The leaves of the kd-tree, which the meta table names too.
#ifndef METAMARCH_LIB_LEAVES_GLSL
#define METAMARCH_LIB_LEAVES_GLSL
#include "lib/scene.glsl"

WORDS4(leafWords, kBindLeaves);

// One load of four words: lavapipe pays for each load, not for its size.
Leaf loadLeaf(const uint leafId) {
    const uvec4 words = LOAD4(leafWords, leafId);
    return Leaf(words.x, words.y, words.z, words.w);
}
#endif
