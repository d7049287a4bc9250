// SPDX-License-Identifier: MIT
// The buffers of rays and of their hits.
#ifndef METAMARCH_LIB_RAYS_GLSL
#define METAMARCH_LIB_RAYS_GLSL
#include "lib/scene.glsl"
#include "shared/ray_query.h"

layout(local_size_x = 64) in;

WORDS4(rayWords, kBindInput);
layout(std430, binding = kBindOutput) writeonly buffer HitBuffer { RayResult results[]; };
layout(push_constant) uniform PushBlock { RaysPush push; };

// Returns the index of the invocation's ray. Indices from push.end on have no ray.
uint rayOfInvocation() {
    return push.first + gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
}

RayQuery loadRay(const uint i) {
    const uvec4 a = LOAD4(rayWords, 2u * i);
    const uvec4 b = LOAD4(rayWords, 2u * i + 1u);
    return RayQuery(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz),
                    uintBitsToFloat(b.w));
}
#endif
