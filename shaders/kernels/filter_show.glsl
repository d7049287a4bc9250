// SPDX-License-Identifier: MIT
// Converts rows of filtered pixels to 8 bits per channel, one invocation per pixel.
#include "lib/filter_rows.glsl"
#include "shared/packed_pixel.h"
#include "shared/tone_mapping.h"

layout(std430, binding = kBindFilterTo) readonly buffer AfterBuffer { FilterLight after[]; };
layout(std430, binding = kBindOutput) buffer PictureBuffer { uint picture[]; };

void main() {
    const ivec2 pixel = filteredPixel();
    if (!isInside(pixel)) {
        return;
    }
    const uint i = indexOf(pixel);
    const vec3 radiance = filteredRadiance(surfaces[i], from[i], after[i], push.kept);
    const uint shown = packedLinear(toneMapped(push.toneOperator, push.scale, radiance));
    picture[i] = (shown & 0xffffffu) | (picture[i] & 0xff000000u); // the part that is covered stays
}
