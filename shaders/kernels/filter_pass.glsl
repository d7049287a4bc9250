// SPDX-License-Identifier: MIT
// One pass of the filter over rows of pixels, one invocation per pixel.
#include "lib/filter_rows.glsl"

layout(std430, binding = kBindFilterShape) readonly buffer ShapeBuffer { FilterShape shapes[]; };
layout(std430, binding = kBindFilterTo) writeonly buffer ToBuffer { FilterLight to[]; };

void main() {
    const ivec2 pixel = filteredPixel();
    if (!isInside(pixel)) {
        return;
    }
    const uint i = indexOf(pixel);
    const FilterLight centre = from[i];
    const FilterSurface surface = surfaces[i];
    if (surface.depth < 0.0) {
        to[i] = centre;
        return;
    }
    const FilterShape shape = shapes[i];
    FilterSum sum = startFilterSum(centre, binomial(0, 0));
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const ivec2 other = pixel + ivec2(dx, dy) * int(push.distance);
            if (!isInside(other) || (dx == 0 && dy == 0)) {
                continue;
            }
            const uint j = indexOf(other);
            const FilterLight light = from[j];
            const float weight = filterWeight(surface, shape, surfaces[j], shapes[j], float(push.distance),
                                              lightDifference(centre, light, push.tolerance));
            sum = addTo(sum, centre, light, binomial(dx, dy) * weight);
        }
    }
    to[i] = meanOf(sum, centre);
}
