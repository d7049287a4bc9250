// SPDX-License-Identifier: MIT
// Loads the bounding volume hierarchy.
#ifndef METAMARCH_LIB_BVH_GLSL
#define METAMARCH_LIB_BVH_GLSL
#include "lib/scene.glsl"
#include "shared/bvh_node.h"

WORDS4(bvhNodeWords, kBindBvhNodes);

BvhNode loadBvhNode(const uint nodeId) {
    const uvec4 a = LOAD4(bvhNodeWords, 4u * nodeId);
    const uvec4 b = LOAD4(bvhNodeWords, 4u * nodeId + 1u);
    const uvec4 c = LOAD4(bvhNodeWords, 4u * nodeId + 2u);
    const uvec4 d = LOAD4(bvhNodeWords, 4u * nodeId + 3u);
    return BvhNode(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w,
                   uintBitsToFloat(d.xyz), d.w);
}
#endif
