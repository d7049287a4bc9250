// SPDX-License-Identifier: MIT
// Keeps the radiance of filtered rows of pixels for filter_show, one invocation per pixel.
#include "lib/filter_rows.glsl"

layout(std430, binding = kBindFilterTo) readonly buffer AfterBuffer { FilterLight after[]; };
layout(std430, binding = kBindOutput) writeonly buffer ResultBuffer { FilterLight result[]; };

void main() {
    const ivec2 pixel = filteredPixel();
    if (!isInside(pixel)) {
        return;
    }
    const uint i = indexOf(pixel);
    result[i] = FilterLight(filteredRadiance(surfaces[i], from[i], after[i], push.kept), 0.0);
}
