// SPDX-License-Identifier: MIT
// Loads the leaves of the kd-tree, to which the meta table refers too.
#ifndef METAMARCH_LIB_LEAVES_GLSL
#define METAMARCH_LIB_LEAVES_GLSL
#include "lib/scene.glsl"

WORDS4(leafWords, kBindLeaves);

// Loads four words at once, because on lavapipe each load costs the same, whatever its size.
Leaf loadLeaf(const uint leafId) {
    const uvec4 words = LOAD4(leafWords, leafId);
    return Leaf(words.x, words.y, words.z, words.w);
}
#endif
