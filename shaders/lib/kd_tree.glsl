// SPDX-License-Identifier: MIT
// The kd-tree: inner nodes and leaves.
#ifndef METAMARCH_LIB_KD_TREE_GLSL
#define METAMARCH_LIB_KD_TREE_GLSL
#include "lib/leaves.glsl"
#include "shared/kd_walk.h"

WORDS2(kdNodeWords, kBindKdNodes);

KdNode loadKdNode(const uint nodeId) {
    const uvec2 words = LOAD2(kdNodeWords, nodeId);
    return KdNode(words.x, words.y);
}

// The leaf of `node`; where a loop was ended on the way down and `node` is none, the trace will not count as
// finished.
Leaf enterLeaf(const KdNode node, inout Trace trace) {
    trace.expectedTests += isLeaf(node) ? 0u : 1u;
    return loadLeaf(leafOf(node));
}
#endif
