// The kd-tree with the way back up: each node's box and parent.
#ifndef METAMARCH_LIB_KD_PARENTS_GLSL
#define METAMARCH_LIB_KD_PARENTS_GLSL
#include "lib/kd_tree.glsl"
#include "shared/kd_parent.h"

layout(std430, binding = kBindKdParents) readonly buffer KdParentBuffer { uvec4 kdParentWords[]; };

KdParent loadKdParent(const uint nodeId) {
    const uvec4 words = kdParentWords[nodeId];
    return KdParent(words.x, words.y, words.z, words.w);
}
#endif
