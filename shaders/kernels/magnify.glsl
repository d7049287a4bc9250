// SPDX-License-Identifier: MIT
// Shows a part of a picture with square blocks in place of its pixels, one invocation per pixel of the
// screen.
#include "shared/scene_layout.h"
#include "shared/screen.h"

layout(local_size_x = kScreenTile) in;

layout(std430, binding = kBindInput) readonly buffer PictureBuffer { uint picture[]; };
layout(std430, binding = kBindOutput) writeonly buffer ScreenBuffer { uint screen[]; };
layout(push_constant) uniform PushBlock { MagnifyPush push; };

void main() {
    const uint x = gl_GlobalInvocationID.x;
    const uint y = gl_GlobalInvocationID.y;
    if (x < push.width) {
        screen[y * push.width + x] = picture[magnifiedPixel(y, push.skippedRows, push.scale) * push.width +
                                             magnifiedPixel(x, push.skippedColumns, push.scale)];
    }
}
