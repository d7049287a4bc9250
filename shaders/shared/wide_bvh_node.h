// SPDX-License-Identifier: MIT
// One inner node of the wide bounding volume hierarchy: the boxes of up to four children, in bytes. After
// H. Ylitie, T. Karras, S. Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs",
// HPG 2017, which has eight children in 80 bytes.
#ifndef METAMARCH_SHARED_WIDE_BVH_NODE_H
#define METAMARCH_SHARED_WIDE_BVH_NODE_H
#include "bvh_node.h"

SHARED_BEGIN

const uint kWideChildren = 4u;

// A plane of a child's box is at origin + number * step, in lattice space. The number is byte i of a word of
// `lo` or `hi` for child i. A child that does not exist has its lo above its hi and the word kEmptyBvhLeaf.
struct WideBvhNode {
    vec3 origin;
    uint steps; // one byte per axis: the exponent bits of the step, which is a power of two
    uvec3 lo;
    uint padding0;
    uvec3 hi;
    uint padding1;
    uint child0; // as in BvhNode; an inner node's id counts wide nodes
    uint child1;
    uint child2;
    uint child3;
};

const uint kMaxWideSteps = 255u;

SHARED_FN float wideStep(const uint steps, const uint axis) {
    return uintBitsToFloat(((steps >> (8u * axis)) & 0xffu) << 23u);
}

// A node's boxes along a ray: t of plane i is tLow + i * tStep. `near` and `far` are the words of the planes
// that the ray meets first and last.
struct WideCrossing {
    vec3 tLow;
    vec3 tStep;
    uvec3 near;
    uvec3 far;
};

SHARED_FN WideCrossing crossWideNode(const Ray ray, const vec3 origin, const uint steps, const uvec3 lo,
                                     const uvec3 hi) {
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    const vec3 step = vec3(wideStep(steps, 0u), wideStep(steps, 1u), wideStep(steps, 2u));
    return WideCrossing((origin - ray.start) * ray.invStride, step * ray.invStride, mix(hi, lo, upward),
                        mix(lo, hi, upward));
}

SHARED_FN vec3 widePlanes(const WideCrossing node, const uvec3 words, const uint shift) {
    const vec3 numbers = vec3(int((words.x >> shift) & 0xffu), int((words.y >> shift) & 0xffu),
                              int((words.z >> shift) & 0xffu));
    return node.tLow + numbers * node.tStep;
}

// Returns the interval of t in which the ray is in the child's box; if it is empty, the first number is the
// larger one. The builder has grown the boxes by far more than the rounding errors here.
SHARED_FN vec2 crossWideChild(const WideCrossing node, const uint child, const float tMax) {
    const vec3 near = widePlanes(node, node.near, 8u * child);
    const vec3 far = widePlanes(node, node.far, 8u * child);
    return vec2(larger(larger(near.x, near.y), larger(near.z, 0.0f)),
                smaller(smaller(far.x, far.y), smaller(far.z, tMax)));
}

// Which children a ray meets: bit i for child i; and the one that it meets first.
struct WideHits {
    uint mask;
    uint first;
};

SHARED_FN WideHits meetWideChildren(const WideCrossing node, const float tMax) {
    const vec2 t0 = crossWideChild(node, 0u, tMax);
    const vec2 t1 = crossWideChild(node, 1u, tMax);
    const vec2 t2 = crossWideChild(node, 2u, tMax);
    const vec2 t3 = crossWideChild(node, 3u, tMax);
    const float n0 = t0.x <= t0.y ? t0.x : kFarthest;
    const float n1 = t1.x <= t1.y ? t1.x : kFarthest;
    const float n2 = t2.x <= t2.y ? t2.x : kFarthest;
    const float n3 = t3.x <= t3.y ? t3.x : kFarthest;
    const uint lower = n0 <= n1 ? 0u : 1u;
    const uint upper = n2 <= n3 ? 2u : 3u;
    return WideHits((t0.x <= t0.y ? 1u : 0u) | (t1.x <= t1.y ? 2u : 0u) | (t2.x <= t2.y ? 4u : 0u) |
                        (t3.x <= t3.y ? 8u : 0u),
                    smaller(n0, n1) <= smaller(n2, n3) ? lower : upper);
}

// What is left of a node on the stack: its id and the mask of the children still to visit.
const uint kWideMaskBits = 4u;
SHARED_FN uint wideRest(const uint nodeId, const uint mask) { return (nodeId << kWideMaskBits) | mask; }
SHARED_FN uint wideRestNode(const uint rest) { return rest >> kWideMaskBits; }
SHARED_FN uint wideRestMask(const uint rest) { return rest & 15u; }

SHARED_FN uint chooseWideChild(const uvec4 children, const uint i) {
    return i < 2u ? (i == 0u ? children.x : children.y) : (i == 2u ? children.z : children.w);
}

SHARED_ASSERT_SIZE(WideBvhNode, 64)
SHARED_ASSERT_OFFSET(WideBvhNode, steps, 12)
SHARED_ASSERT_OFFSET(WideBvhNode, lo, 16)
SHARED_ASSERT_OFFSET(WideBvhNode, padding0, 28)
SHARED_ASSERT_OFFSET(WideBvhNode, hi, 32)
SHARED_ASSERT_OFFSET(WideBvhNode, padding1, 44)
SHARED_ASSERT_OFFSET(WideBvhNode, child0, 48)
SHARED_ASSERT_OFFSET(WideBvhNode, child1, 52)
SHARED_ASSERT_OFFSET(WideBvhNode, child2, 56)
SHARED_ASSERT_OFFSET(WideBvhNode, child3, 60)

SHARED_END
#endif
