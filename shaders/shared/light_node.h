// SPDX-License-Identifier: MIT
// A node of the tree of lights (light_tree.h).
#ifndef METAMARCH_SHARED_LIGHT_NODE_H
#define METAMARCH_SHARED_LIGHT_NODE_H
#include "math.h"

SHARED_BEGIN

// What a node knows of its lights. Each light shines within `end` of a direction, its normal, and with the
// cosine of the angle to it. All normals are within `spread` of the axis.
struct LightNode {
    vec3 center; // of a sphere around all points that shine
    float radius;
    uint axis; // packAxis, and bits kLightLeaf and kLightTwoSided
    uint cosines;
    float intensity; // sum over the lights: W/sr along the normal
    // The index of the first child, which the second follows. Of a leaf, the index of its light: emitters
    // come first, then punctual lights.
    uint link;
};

const uint kLightLeaf = 1u << 30u;
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

// Packs the cosines of `spread` and `end`, both rounded down: the node may only become larger.
SHARED_FN uint packCosines(const float spread, const float end) {
    const float a = min(max(floor((spread + 1.0f) * 32767.0f), 0.0f), 65534.0f);
    const float b = min(max(floor((end + 1.0f) * 32767.0f), 0.0f), 65534.0f);
    return uint(a) | (uint(b) << 16u);
}

SHARED_FN vec2 unpackCosines(const uint cosines) {
    return vec2(float(cosines & 0xffffu), float(cosines >> 16u)) / 32767.0f - 1.0f;
}

SHARED_ASSERT_SIZE(LightNode, 32)
SHARED_ASSERT_OFFSET(LightNode, radius, 12)
SHARED_ASSERT_OFFSET(LightNode, axis, 16)
SHARED_ASSERT_OFFSET(LightNode, cosines, 20)
SHARED_ASSERT_OFFSET(LightNode, intensity, 24)
SHARED_ASSERT_OFFSET(LightNode, link, 28)

SHARED_END
#endif
