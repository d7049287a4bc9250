// SPDX-License-Identifier: MIT
#version 460
// outputs[i] = factor * inputs[i] + offset in integers; the factor is a specialization constant, the offset a
// push constant.
layout(local_size_x = 64) in;
layout(constant_id = 7) const uint kFactor = 1u;

layout(std430, binding = 1) readonly buffer InputBuffer { uint inputs[]; };
layout(std430, binding = 4) writeonly buffer OutputBuffer { uint outputs[]; };
layout(push_constant) uniform Push {
    uint offset;
    uint count;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < count) {
        outputs[i] = kFactor * inputs[i] + offset;
    }
}
