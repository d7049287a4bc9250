// Light from all around as an equirectangular map: u = 0.5 + atan2(z, x) / 2 pi from the left, v = acos(y) /
// pi from the top. Its texels are drawn by the light they send: a table of the rows, and one of the
// columns for each.
#ifndef METAMARCH_SHARED_ENVIRONMENT_MAP_H
#define METAMARCH_SHARED_ENVIRONMENT_MAP_H
#include "light.h"

SHARED_BEGIN

// The sine of the angle to the y axis, of a direction of unit length.
SHARED_FN float mapSine(const vec3 direction) {
    return sqrt(direction.x * direction.x + direction.z * direction.z);
}

// Of a direction of unit length; u and v in [0, 1]. By the sine too: near the poles the cosine has lost the
// angle.
SHARED_FN vec2 mapPoint(const vec3 direction) {
    return vec2(0.5f + arcTangent(direction.z, direction.x) * (0.5f * kInvPi),
                arcTangent(mapSine(direction), direction.y) * kInvPi);
}

SHARED_FN vec3 mapDirection(const vec2 point) {
    const vec2 around = circlePoint(point.x - 0.5f);
    const vec2 down = circlePoint(point.y * 0.5f);
    return vec3(around.x * down.y, down.x, around.y * down.y);
}

// The area of the map in angles, 2 pi * pi. Written out: glslang multiplies constants in double precision.
const float kMapArea = 19.7392088021787172f;

// Per solid angle, of a direction in the texel that the two tables draw with these probabilities. `sine` is
// mapSine's: 0 has no density.
SHARED_FN float mapDensity(const float rowProbability, const float columnProbability, const uint width,
                           const uint height, const float sine) {
    const float perSquare = rowProbability * columnProbability * float(width) * float(height);
    return sine > 0.0f ? perSquare / (kMapArea * sine) : 0.0f;
}

// Where in the map, from the choices of row and column and what they left over.
SHARED_FN vec2 mapPointIn(const TableChoice row, const TableChoice column, const uint width,
                          const uint height) {
    return vec2((float(column.index) + column.rest) / float(width),
                (float(row.index) + row.rest) / float(height));
}

SHARED_END
#endif
