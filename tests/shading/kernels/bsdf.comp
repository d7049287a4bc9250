// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 0) const uint kFeatures = 0xffffffffu;
#define SHADING_FEATURES kFeatures
#include "shading/bsdf_case.h"
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer InputBuffer { BsdfCase inputs[]; };
layout(std430, binding = 1) writeonly buffer OutputBuffer { BsdfAnswer outputs[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        outputs[i] = answer(inputs[i]);
    }
}
