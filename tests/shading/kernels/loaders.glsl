// SPDX-License-Identifier: MIT
// What the loaders of lib/shading.glsl make of the scene's buffers: one element of each an invocation.
#include "lib/shading.glsl"
#include "shading/loaded_records.h"
layout(local_size_x = 1) in;

layout(std430, binding = kBindOutput) writeonly buffer OutputBuffer { LoadedRecords outputs[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    outputs[i] = loadedRecords(i);
}
