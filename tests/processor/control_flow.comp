// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "control_flow.h"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer GivenBuffer { uint given[]; };
layout(std430, binding = 1) writeonly buffer ResultBuffer { uvec4 results[]; };
layout(std430, binding = 2) writeonly buffer MoreBuffer { uvec4 more[]; };
layout(std430, binding = 3) buffer SumBuffer { uint sum; };
layout(std430, binding = 4) readonly buffer SettingBuffer { Setting kept[]; };
layout(push_constant) uniform PushBlock { Setting pushed; };

void main() {
    const uint i = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
    const uint x = given[i];
    if (x == 0xffffffffu) {
        return;
    }
    results[i] = uvec4(early(x), turns(x), nested(x), structs(x));
    more[i] = uvec4(numbers(x), halves(x), outOfTwo(x), settings(pushed, kept[1], x));
    atomicAdd(sum, x);
}
