// SPDX-License-Identifier: MIT
// Brings what the filter of the display needs of some tiles of a film into rows, one invocation per pixel.
#include "lib/tiles.glsl"
#include "shared/display_filter.h"

layout(std430, binding = kBindInput) readonly buffer FilmBuffer { FilmPixel film[]; };
layout(std430, binding = kBindTotal) readonly buffer TotalBuffer { FilmPixel total[]; };
layout(std430, binding = kBindFilterSurface) writeonly buffer SurfaceBuffer { FilterSurface surfaces[]; };
layout(std430, binding = kBindFilterShape) writeonly buffer ShapeBuffer { FilterShape shapes[]; };
layout(std430, binding = kBindFilterTo) writeonly buffer LightBuffer { FilterLight lights[]; };
layout(push_constant) uniform PushBlock { FilterBeginPush push; };

void main() {
    const uint place = push.firstPlace + gl_WorkGroupID.x;
    const uvec2 pixel = pixelAt(push.order, place);
    if (pixel.x >= push.width || pixel.y >= push.height) {
        return;
    }
    const uint index = (place - push.bandPlace) * kTilePixels + gl_LocalInvocationIndex;
    const FilmPixel sum = addPixel(total[index], film[index]);
    const uint at = pixel.y * push.width + pixel.x;
    surfaces[at] = filterSurface(sum);
    shapes[at] = filterShape(sum);
    lights[at] = filterLight(sum);
}
