// SPDX-License-Identifier: MIT
// The way back up the kd-tree: one record per node.
#ifndef METAMARCH_SHARED_KD_PARENT_H
#define METAMARCH_SHARED_KD_PARENT_H
#include "march.h"

SHARED_BEGIN

struct KdParent {
    uint lo;     // packCell: the node's box of whole cells
    uint hi;     // packCell, exclusive
    uint parent; // node id; the root is its own parent
    uint padding;
};

// Returns the t at which the ray leaves the box [lo, hi). It has the same bits as KdFork::tSplit of that
// plane.
SHARED_FN float exitOf(const Ray ray, const KdParent node) {
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    const ivec3 plane = mix(unpackCell(node.lo), unpackCell(node.hi), upward);
    const vec3 t = (vec3(plane) - ray.start) * ray.invStride;
    return smallest(t);
}

SHARED_ASSERT_SIZE(KdParent, 16)
SHARED_ASSERT_OFFSET(KdParent, hi, 4)
SHARED_ASSERT_OFFSET(KdParent, parent, 8)
SHARED_ASSERT_OFFSET(KdParent, padding, 12)

SHARED_END
#endif
