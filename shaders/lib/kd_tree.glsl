// The kd-tree: inner nodes and leaves.
#ifndef METAMARCH_LIB_KD_TREE_GLSL
#define METAMARCH_LIB_KD_TREE_GLSL
#include "lib/leaves.glsl"
#include "shared/kd_walk.h"

layout(std430, binding = kBindKdNodes) readonly buffer KdNodeBuffer { uvec2 kdNodeWords[]; };

KdNode loadKdNode(const uint nodeId) {
    const uvec2 words = kdNodeWords[nodeId];
    return KdNode(words.x, words.y);
}
#endif
