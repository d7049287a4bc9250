// SPDX-License-Identifier: MIT
// Composites a fine picture over a coarse one at the screen's size, and both over a backdrop, one invocation
// per pixel of the screen.
#include "shared/backdrop.h"
#include "shared/scene_layout.h"
#include "shared/screen.h"

layout(local_size_x = kScreenTile) in;

layout(constant_id = kSpecBackdrop) const uint hasBackdrop = 0u;

layout(std430, binding = kBindInput) readonly buffer FineBuffer { uint fine[]; };
layout(std430, binding = kBindCoarse) readonly buffer CoarseBuffer { uint coarse[]; };
layout(std430, binding = kBindOutput) writeonly buffer ScreenBuffer { uint screen[]; };
layout(std430, binding = kBindBackdrop) readonly buffer BackdropBuffer { vec4 backdrop[]; };
layout(push_constant) uniform PushBlock { PresentPush push; };

vec3 backdropAt(const uint x, const uint y) {
    const BackdropPlace place =
        backdropPlace(x, y, push.width, push.height, push.backdropColumns, push.backdropRows);
    return backdropBetween(backdrop[place.upperLeft].xyz, backdrop[place.upperRight].xyz,
                           backdrop[place.lowerLeft].xyz, backdrop[place.lowerRight].xyz, place);
}

void main() {
    const uint x = push.firstColumn + gl_GlobalInvocationID.x;
    const uint y = gl_GlobalInvocationID.y;
    if (x >= push.endColumn) {
        return;
    }
    const uint fineX = pixelUnder(x, push.fineWidth, push.width);
    const uint fineY = pixelUnder(y, push.fineHeight, push.height);
    uint pixel = fine[fineY * push.fineWidth + fineX];
    if ((pixel >> 24u) == 0u) {
        const uint coarseX = pixelUnder(x, push.coarseWidth, push.width);
        const uint coarseY = pixelUnder(y, push.coarseHeight, push.height);
        pixel = coarse[coarseY * push.coarseWidth + coarseX];
    }
    if (hasBackdrop != 0u) {
        pixel = overBackdrop(pixel, backdropAt(x, y));
    }
    pixel |= 0xff000000u;
    screen[y * push.width + x] = push.isBlueFirst != 0u ? withBlueFirst(pixel) : pixel;
}
