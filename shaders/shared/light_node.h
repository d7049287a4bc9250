// SPDX-License-Identifier: MIT
// A node of the tree of lights (light_tree.h).
#ifndef METAMARCH_SHARED_LIGHT_NODE_H
#define METAMARCH_SHARED_LIGHT_NODE_H
#include "math.h"

SHARED_BEGIN

// What a node knows of its lights. All their normals are within the angle `spread` of the axis, and they
// shine at most at the angle `end` to a normal, with its cosine.
struct LightNode {
    vec3 center; // of a sphere around all points that shine
    float radius;
    uint axis;       // packAxis, and bit kLightTwoSided
    uint angles;     // packAngles
    float intensity; // sum over the lights: W/sr along the normal
    // The index of the first child, which the second follows. Of a leaf, kLightLeaf and the index of its
    // light: emitters come first, then punctual lights.
    uint link;
};

const uint kLightLeaf = 1u << 31u;
const uint kLightTwoSided = 1u << 31u; // its lights shine along their normals and against them
// A light is at most this number of branches below the root.
const uint kMaxLightDepth = 32u;

// Packs a direction with 10 bits for each component. It need not have unit length.
SHARED_FN uint packAxis(const vec3 axis) {
    const vec3 scaled = axis / max(largest(abs(axis)), 1e-30f) * 511.0f + 511.5f;
    return uint(scaled.x) | (uint(scaled.y) << 10u) | (uint(scaled.z) << 20u);
}

// Returns the direction with unit length. The host measures `spread` from this direction, so packing loses
// nothing.
SHARED_FN vec3 unpackAxis(const uint packedAxis) {
    const vec3 whole = vec3(float(packedAxis & 1023u), float((packedAxis >> 10u) & 1023u),
                            float((packedAxis >> 20u) & 1023u));
    return unitVector(whole - 511.0f);
}

// Packs the angles `spread` and `end`, given by their cosines, as sines of half angles in 16 bits each. Both
// are rounded up, so a node may only become larger.
SHARED_FN uint packAngles(const float cosSpread, const float cosEnd) {
    const vec2 halves = sqrt(max(vec2(1.0f - cosSpread, 1.0f - cosEnd) * 0.5f, vec2(0.0f)));
    const vec2 steps = min(ceil(halves * 65535.0f) + 1.0f, vec2(65535.0f));
    return uint(steps.x) | (uint(steps.y) << 16u);
}

// Returns the cosines of both angles.
SHARED_FN vec2 unpackCosines(const uint angles) {
    const vec2 halves = vec2(float(angles & 0xffffu), float(angles >> 16u)) / 65535.0f;
    return 1.0f - halves * halves * 2.0f;
}

SHARED_ASSERT_SIZE(LightNode, 32)
SHARED_ASSERT_OFFSET(LightNode, radius, 12)
SHARED_ASSERT_OFFSET(LightNode, axis, 16)
SHARED_ASSERT_OFFSET(LightNode, angles, 20)
SHARED_ASSERT_OFFSET(LightNode, intensity, 24)
SHARED_ASSERT_OFFSET(LightNode, link, 28)

SHARED_END
#endif
