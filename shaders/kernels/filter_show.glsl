// SPDX-License-Identifier: MIT
// Converts rows of filtered pixels to 8 bits per channel, one invocation per pixel.
#include "lib/filter_rows.glsl"
#include "shared/packed_pixel.h"
#include "shared/tone_mapping.h"

layout(std430, binding = kBindOutput) buffer PictureBuffer { uint picture[]; };

void main() {
    const ivec2 pixel = filteredPixel();
    if (!isInside(pixel)) {
        return;
    }
    const uint i = indexOf(pixel);
    const uint shown = packedLinear(toneMapped(push.toneOperator, push.scale, from[i].light));
    picture[i] = (shown & 0xffffffu) | (picture[i] & 0xff000000u); // the part that is covered stays
}
