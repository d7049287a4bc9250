// SPDX-License-Identifier: MIT
// Calls the loaders of lib/shading.glsl; each invocation loads one element of each buffer.
#include "lib/shading.glsl"
#include "shading/loaded_records.h"
layout(local_size_x = 1) in;

layout(std430, binding = kBindOutput) writeonly buffer OutputBuffer { LoadedRecords outputs[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    outputs[i] = loadedRecords(i);
}
