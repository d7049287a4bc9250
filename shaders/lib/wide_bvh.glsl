// SPDX-License-Identifier: MIT
// Loads the wide bounding volume hierarchy.
#ifndef METAMARCH_LIB_WIDE_BVH_GLSL
#define METAMARCH_LIB_WIDE_BVH_GLSL
#include "lib/scene.glsl"
#include "shared/wide_bvh_node.h"

WORDS4(wideNodeWords, kBindBvhNodes);

WideCrossing crossWideNodeOf(const Ray ray, const uint nodeId) {
    const uvec4 a = LOAD4(wideNodeWords, 4u * nodeId);
    const uvec4 b = LOAD4(wideNodeWords, 4u * nodeId + 1u);
    const uvec4 c = LOAD4(wideNodeWords, 4u * nodeId + 2u);
    return crossWideNode(ray, uintBitsToFloat(a.xyz), a.w, b.xyz, c.xyz);
}

uvec4 loadWideChildren(const uint nodeId) { return LOAD4(wideNodeWords, 4u * nodeId + 3u); }
#endif
