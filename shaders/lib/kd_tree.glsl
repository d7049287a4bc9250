// SPDX-License-Identifier: MIT
// Loads the inner nodes and the leaves of the kd-tree.
#ifndef METAMARCH_LIB_KD_TREE_GLSL
#define METAMARCH_LIB_KD_TREE_GLSL
#include "lib/leaves.glsl"
#include "shared/kd_walk.h"

WORDS2(kdNodeWords, kBindKdNodes);

KdNode loadKdNode(const uint nodeId) {
    const uvec2 words = LOAD2(kdNodeWords, nodeId);
    return KdNode(words.x, words.y);
}

// Returns the leaf of `node`. If the driver ended the loop on the way down, `node` is not a leaf, and the
// trace will not count as finished.
Leaf enterLeaf(const KdNode node, inout Trace trace) {
    trace.expectedTests += isLeaf(node) ? 0u : 1u;
    return loadLeaf(leafOf(node));
}
#endif
