// Light from all around as an equirectangular map: u = 0.5 + atan2(z, x) / 2 pi from the left, v = acos(y) /
// pi from the top. Its texels are drawn by the light they send: an alias table of the rows, and one of the
// columns for each.
#ifndef METAMARCH_SHARED_ENVIRONMENT_MAP_H
#define METAMARCH_SHARED_ENVIRONMENT_MAP_H
#include "shared/light.h"

SHARED_BEGIN

// Of a direction of unit length; u and v in [0, 1].
SHARED_FN vec2 mapPoint(const vec3 direction) {
    return vec2(0.5f + arcTangent(direction.z, direction.x) * (0.5f * kInvPi),
                arcCosine(direction.y) * kInvPi);
}

SHARED_FN vec3 mapDirection(const vec2 point) {
    const vec2 around = circlePoint(point.x - 0.5f);
    const vec2 down = circlePoint(point.y * 0.5f);
    return vec3(around.x * down.y, down.x, around.y * down.y);
}

// Of the map in radians, 2 pi times pi. A literal: glslang folds products of constants in doubles.
const float kMapArea = 19.7392088021787173f;

// Per solid angle, of a direction in the texel that the two tables draw with these probabilities. `sine` is
// that of the angle to the y axis: 0 has no density.
SHARED_FN float mapDensity(const float rowProbability, const float columnProbability, const uint width,
                           const uint height, const float sine) {
    const float perSquare = rowProbability * columnProbability * float(width) * float(height);
    return sine > 0.0f ? perSquare / (kMapArea * sine) : 0.0f;
}

// The sine of mapDensity, of a direction of unit length.
SHARED_FN float mapSine(const vec3 direction) {
    return sqrt(direction.x * direction.x + direction.z * direction.z);
}

// Where in the map, from the choices of row and column and what they left over.
SHARED_FN vec2 mapPointIn(const AliasChoice row, const AliasChoice column, const uint width,
                          const uint height) {
    return vec2((float(column.index) + column.rest) / float(width),
                (float(row.index) + row.rest) / float(height));
}

SHARED_END
#endif
