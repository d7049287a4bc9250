// SPDX-License-Identifier: MIT
// Light from all directions as an equirectangular map: u = 0.5 + atan2(z, x) / 2 pi from the left, v =
// acos(y) / pi from the top. Texels are sampled by the light that they send: one table for the rows, and for
// each row one for its columns.
#ifndef METAMARCH_SHARED_ENVIRONMENT_MAP_H
#define METAMARCH_SHARED_ENVIRONMENT_MAP_H
#include "light.h"

SHARED_BEGIN

// Returns the sine of the angle between a direction (unit length) and the y axis.
SHARED_FN float mapSine(const vec3 direction) {
    return sqrt(direction.x * direction.x + direction.z * direction.z);
}

// Maps a direction (unit length) to u and v in [0, 1]. Uses the sine too, because near the poles the cosine
// loses the precision of the angle.
SHARED_FN vec2 mapPoint(const vec3 direction) {
    return vec2(0.5f + arcTangent(direction.z, direction.x) * (0.5f * kInvPi),
                arcTangent(mapSine(direction), direction.y) * kInvPi);
}

SHARED_FN vec3 mapDirection(const vec2 point) {
    const vec2 around = circlePoint(point.x - 0.5f);
    const vec2 down = circlePoint(point.y * 0.5f);
    return vec3(around.x * down.y, down.x, around.y * down.y);
}

// The area of the map in angles, 2 pi * pi. It is written out because glslang multiplies constants in double
// precision.
const float kMapArea = 19.7392088021787172f;

// Returns the pdf per solid angle of a direction in the texel that the two tables draw with these
// probabilities. `sine` is the result of mapSine; the pdf is 0 if it is 0.
SHARED_FN float mapDensity(const float rowProbability, const float columnProbability, const uint width,
                           const uint height, const float sine) {
    const float perSquare = rowProbability * columnProbability * float(width) * float(height);
    return sine > 0.0f ? perSquare / (kMapArea * sine) : 0.0f;
}

// Returns the point of the map that the choices of row and column and their remainders give.
SHARED_FN vec2 mapPointIn(const TableChoice row, const TableChoice column, const uint width,
                          const uint height) {
    return vec2((float(column.index) + column.uRemapped) / float(width),
                (float(row.index) + row.uRemapped) / float(height));
}

SHARED_END
#endif
