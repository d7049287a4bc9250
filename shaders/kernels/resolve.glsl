// SPDX-License-Identifier: MIT
// Converts the radiance of some tiles of a film to 8 bits per channel, one invocation per pixel.
#include "lib/tiles.glsl"
#include "shared/backdrop.h"
#include "shared/film.h"
#include "shared/screen.h"
#include "shared/tone_mapping.h"

layout(std430, binding = kBindInput) readonly buffer FilmBuffer { FilmPixel film[]; };
layout(std430, binding = kBindTotal) readonly buffer TotalBuffer { FilmPixel total[]; };
layout(std430, binding = kBindOutput) writeonly buffer PictureBuffer { uint picture[]; };
layout(push_constant) uniform PushBlock { ResolvePush push; };

void main() {
    const uint place = push.firstPlace + gl_WorkGroupID.x;
    const uvec2 pixel = pixelAt(push.order, place);
    if (pixel.x >= push.width || pixel.y >= push.height) {
        return;
    }
    const uint index = (place - push.bandPlace) * kTilePixels + gl_LocalInvocationIndex;
    const FilmPixel sum = addPixel(total[index], film[index]);
    const vec3 shown = toneMapped(push.toneOperator, push.scale, meanRadiance(sum));
    picture[pixel.y * push.width + pixel.x] =
        sum.samples == 0u ? 0u : withCoverage(packedLinear(shown), coverage(sum));
}
