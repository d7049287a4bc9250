// SPDX-License-Identifier: MIT
// Finds slope and variance of rows of pixels, one invocation per pixel. The variance of a few samples is
// itself noisy, so it is that of neighbours too; single samples have only their neighbours.
#include "lib/filter_rows.glsl"

layout(std430, binding = kBindFilterShape) buffer ShapeBuffer { FilterShape shapes[]; };
layout(std430, binding = kBindFilterTo) writeonly buffer ToBuffer { FilterLight to[]; };

float depthAt(const ivec2 pixel) { return isInside(pixel) ? surfaces[indexOf(pixel)].depth : kNotFiltered; }

float varianceAmong(const ivec2 pixel, const FilterSurface surface, const FilterShape shape,
                    const FilterLight centre) {
    const float light = luminance(centre.light);
    float weights = 1.0;
    float sum = 0.0;
    float squares = 0.0;
    for (int dy = -kFilterReach; dy <= kFilterReach; ++dy) {
        for (int dx = -kFilterReach; dx <= kFilterReach; ++dx) {
            const ivec2 other = pixel + ivec2(dx, dy);
            if (!isInside(other) || (dx == 0 && dy == 0)) {
                continue;
            }
            const uint i = indexOf(other);
            const float pixels = float(max(abs(dx), abs(dy)));
            // Only the normal of the other shape counts, and no invocation writes that.
            const float weight =
                filterWeight(surface, shape, surfaces[i], FilterShape(shapes[i].normal, 0.0), pixels, 0.0);
            const float change = luminance(from[i].light) - light;
            weights += weight;
            sum += weight * change;
            squares += weight * change * change;
        }
    }
    return max(squares / weights - squared(sum / weights), 0.0);
}

float blurredVariance(const ivec2 pixel) {
    float weights = 0.0;
    float sum = 0.0;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const ivec2 other = pixel + ivec2(dx, dy);
            if (depthAt(other) < 0.0) {
                continue;
            }
            weights += binomial(dx, dy);
            sum += binomial(dx, dy) * from[indexOf(other)].variance;
        }
    }
    return sum / weights;
}

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
    const ivec2 right = ivec2(kSlopeReach, 0);
    const ivec2 down = ivec2(0, kSlopeReach);
    const float slope = max(slopeBetween(depthAt(pixel - right), surface.depth, depthAt(pixel + right)),
                            slopeBetween(depthAt(pixel - down), surface.depth, depthAt(pixel + down)));
    shapes[i].slope = slope;
    const FilterShape shape = FilterShape(shapes[i].normal, slope);
    to[i] = FilterLight(centre.light, push.isSingle != 0u ? varianceAmong(pixel, surface, shape, centre)
                                                          : blurredVariance(pixel));
}
