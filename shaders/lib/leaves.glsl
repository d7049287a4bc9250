// The leaves of the kd-tree, which the meta table names too.
#ifndef METAMARCH_LIB_LEAVES_GLSL
#define METAMARCH_LIB_LEAVES_GLSL
#include "lib/scene.glsl"

layout(std430, binding = kBindLeaves) readonly buffer LeafBuffer { uvec4 leafWords[]; };

// One load of four words: lavapipe pays for each load, not for its size.
Leaf loadLeaf(const uint leafId) {
    const uvec4 words = leafWords[leafId];
    return Leaf(words.x, words.y, words.z, words.w);
}
#endif
