// SPDX-License-Identifier: MIT
// One inner node of the bounding volume hierarchy: the boxes of its two children, in lattice space.
#ifndef METAMARCH_SHARED_BVH_NODE_H
#define METAMARCH_SHARED_BVH_NODE_H
#include "interval.h"
#include "ray.h"

SHARED_BEGIN

// The longest path from the root to a leaf, in edges. The builder obeys it, so a stack of this size cannot
// overflow.
const uint kMaxBvhDepth = 48u;

// A child is an inner node's id, or a leaf: kBvhLeaf | triangle count << 27 | first triangle.
const uint kBvhLeaf = 0x80000000u;
const uint kMaxBvhLeafTriangles = 15u;
const uint kMaxBvhTriangles = 0x08000000u;
const uint kEmptyBvhLeaf = kBvhLeaf; // no triangles; stands for no child

struct BvhNode {
    vec3 lo0;
    uint child0;
    vec3 hi0;
    uint child1;
    vec3 lo1;
    uint padding0;
    vec3 hi1;
    uint padding1;
};

SHARED_FN bool isBvhLeaf(const uint child) { return (child & kBvhLeaf) != 0u; }
SHARED_FN uint bvhTriangleCount(const uint child) { return (child >> 27u) & 15u; }
SHARED_FN uint bvhFirstTriangle(const uint child) { return child & 0x07ffffffu; }

// Returns the interval (near, far) of t in which the ray is in the box; if near > far, it misses the box. The
// builder has grown the boxes by far more than the rounding errors here.
SHARED_FN vec2 crossBox(const Ray ray, const vec3 lo, const vec3 hi, const float tMax) {
    const vec3 t0 = (lo - ray.start) * ray.invStride;
    const vec3 t1 = (hi - ray.start) * ray.invStride;
    const float near = larger(larger(smaller(t0.x, t1.x), smaller(t0.y, t1.y)), smaller(t0.z, t1.z));
    const float far = smaller(smaller(larger(t0.x, t1.x), larger(t0.y, t1.y)), larger(t0.z, t1.z));
    return vec2(larger(near, 0.0f), smaller(far, tMax));
}

SHARED_ASSERT_SIZE(BvhNode, 64)
SHARED_ASSERT_OFFSET(BvhNode, child0, 12)
SHARED_ASSERT_OFFSET(BvhNode, hi0, 16)
SHARED_ASSERT_OFFSET(BvhNode, child1, 28)
SHARED_ASSERT_OFFSET(BvhNode, lo1, 32)
SHARED_ASSERT_OFFSET(BvhNode, padding0, 44)
SHARED_ASSERT_OFFSET(BvhNode, hi1, 48)
SHARED_ASSERT_OFFSET(BvhNode, padding1, 60)

SHARED_END
#endif
