// SPDX-License-Identifier: MIT
// Adds the complete blocks of the pixels of some tiles to the film, one invocation per pixel.
#include "lib/tiles.glsl"
#include "shared/film.h"
#include "shared/path_input.h"

layout(std430, binding = kBindOutput) readonly buffer FilmBuffer { FilmPixel film[]; };
layout(std430, binding = kBindLight) readonly buffer LightBuffer { LightParts filmLight[]; };
layout(std430, binding = kBindTotal) buffer TotalBuffer { FilmPixel total[]; };
layout(std430, binding = kBindTotalLight) buffer TotalLightBuffer { LightParts totalLight[]; };
layout(push_constant) uniform PushBlock { AddBlockPush push; };
layout(constant_id = kSpecFilm) const uint filmParts = kFilmLight;

void main() {
    const uint index = (push.firstPlace + gl_WorkGroupID.x) * kTilePixels + gl_LocalInvocationIndex;
    const FilmPixel sum = total[index];
    total[index] = addPixel(sum, film[index]);
    if ((filmParts & kFilmLight) != 0u) {
        totalLight[index] = addPixelLight(sum, totalLight[index], filmLight[index]);
    }
}
