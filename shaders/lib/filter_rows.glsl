// SPDX-License-Identifier: MIT
// The pixels of the kernels that filter rows of the display, and their buffers.
#ifndef METAMARCH_LIB_FILTER_ROWS_GLSL
#define METAMARCH_LIB_FILTER_ROWS_GLSL
#include "shared/display_filter.h"

layout(local_size_x = kFilterRow) in;

layout(std430, binding = kBindFilterSurface) readonly buffer SurfaceBuffer { FilterSurface surfaces[]; };
layout(std430, binding = kBindFilterFrom) readonly buffer FromBuffer { FilterLight from[]; };
layout(push_constant) uniform PushBlock { FilterPush push; };

ivec2 filteredPixel() { return ivec2(gl_GlobalInvocationID.x, push.firstRow + gl_GlobalInvocationID.y); }

bool isInside(const ivec2 pixel) {
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x < int(push.width) && pixel.y < int(push.height);
}

uint indexOf(const ivec2 pixel) { return uint(pixel.y) * push.width + uint(pixel.x); }
#endif
