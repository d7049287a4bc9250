// SPDX-License-Identifier: MIT
// One node of the kd-tree, 8 bytes. Nodes are in depth-first order: the child below the plane is the next
// node.
#ifndef METAMARCH_SHARED_KD_NODE_H
#define METAMARCH_SHARED_KD_NODE_H
#include "interop.h"

SHARED_BEGIN

// The longest path from the root to a leaf, in edges. The builder obeys it, so a stack of this size cannot
// overflow.
const uint kMaxTreeDepth = 48u;

struct KdNode {
    uint tag;    // inner: axis (0..2) | lattice plane << 2; leaf: 3
    uint target; // inner: the child above the plane; leaf: its leaf id
};

SHARED_FN bool isLeaf(const KdNode node) { return (node.tag & 3u) == 3u; }
SHARED_FN uint splitAxis(const KdNode node) { return node.tag & 3u; }
SHARED_FN uint splitPlane(const KdNode node) { return node.tag >> 2u; }
SHARED_FN uint childAbove(const KdNode node) { return node.target; }
SHARED_FN uint leafOf(const KdNode node) { return node.target; }

SHARED_ASSERT_SIZE(KdNode, 8)
SHARED_ASSERT_OFFSET(KdNode, target, 4)

SHARED_END
#endif
