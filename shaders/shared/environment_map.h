// SPDX-License-Identifier: MIT
// Light from all directions as an equirectangular map: u = 0.5 + atan2(z, x) / 2 pi from the left, v =
// acos(y) / pi from the top.
//
// The map is filtered bilinearly, and is sampled by a weight that is filtered in the same way: each texel has
// one. The cells between the centres of four texels are drawn from tables, and the place in the cell from the
// bilinear function itself. So the density over the unit square of (u, v) is the filtered weight, times a
// factor that is constant in a block of cells.
//
// A surface sees half of the map, and most of that at an angle. Therefore the normals of surfaces are divided
// into bins, and each bin has a table of all blocks that contains the cosine. Further tables, for the rows of
// a block and for the columns of such a row, serve all bins.
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

// Returns the pdf per solid angle of a direction where the filtered weight is `weight`. `sine` is the result
// of mapSine; the pdf is 0 if it is 0.
SHARED_FN float mapDensity(const float weight, const float sine) {
    return sine > 0.0f ? weight / (kMapArea * sine) : 0.0f;
}

// Bins of normals: each face of a cube has kBinsAlong * kBinsAlong. One more is for surfaces that scatter
// light from both sides.
const uint kBinsAlong = 3u;
const uint kNormalBins = 54u;
const uint kAnyNormal = kNormalBins;

// Returns the bin of a normal of unit length.
SHARED_FN uint normalBin(const vec3 normal) {
    const vec3 size = abs(normal);
    const bool isX = size.x >= size.y && size.x >= size.z;
    const bool isY = !isX && size.y >= size.z;
    const float major = isX ? normal.x : isY ? normal.y : normal.z;
    const float a = isX ? normal.y : normal.x;
    const float b = isX || isY ? normal.z : normal.y;
    const float middle = 0.5f * float(kBinsAlong);
    const float scale = middle / abs(major);
    const uint i = min(uint(a * scale + middle), kBinsAlong - 1u);
    const uint j = min(uint(b * scale + middle), kBinsAlong - 1u);
    const uint face = (isX ? 0u : isY ? 2u : 4u) + (major < 0.0f ? 1u : 0u);
    return (face * kBinsAlong + j) * kBinsAlong + i;
}

// A map has at most kBlocksAcross * kBlocksDown blocks. The sides of a block are powers of two, but those of
// the last blocks of an axis may be less.
const uint kBlocksAcross = 16u;
const uint kBlockRowShift = 4u; // log2 of kBlocksAcross
const uint kBlocksDown = 9u;
const uint kMapBlocks = 144u;

// A place in a cell. The cells of column c lie between the centres of texels c and c + 1; behind the last
// texel follows the first. The cells of row r lie between the centres of texels r - 1 and r. Beyond the first
// and the last texel, at the poles, are halves of cells: `down` is at least 0.5 in the first row, and at most
// 0.5 in the last one.
struct MapPlace {
    uint column; // below the width of the map
    uint row;    // at most the height of the map
    float right; // from 0 to 1
    float down;
};

SHARED_FN MapPlace mapPlace(const vec2 point, const uint width, const uint height) {
    const float x = point.x * float(width) - 0.5f;
    const float y = point.y * float(height) + 0.5f;
    const float left = floor(x);
    const float top = min(floor(y), float(height));
    const uint column = left < 0.0f ? width - 1u : min(uint(left), width - 1u);
    return MapPlace(column, uint(top), x - left, y - top);
}

// u may reach 1 + 1 / width; the map is periodic there.
SHARED_FN vec2 mapPointOf(const MapPlace place, const uint width, const uint height) {
    return vec2((float(place.column) + 0.5f + place.right) / float(width),
                (float(place.row) - 0.5f + place.down) / float(height));
}

// The texels at the corners of a cell: radiance in rgb, the weight for sampling in a.
struct MapCorners {
    vec4 upperLeft;
    vec4 upperRight;
    vec4 lowerLeft;
    vec4 lowerRight;
};

SHARED_FN vec4 filteredTexel(const MapCorners corners, const float right, const float down) {
    const vec4 upper = corners.upperLeft * (1.0f - right) + corners.upperRight * right;
    const vec4 lower = corners.lowerLeft * (1.0f - right) + corners.lowerRight * right;
    return upper * (1.0f - down) + lower * down;
}

// Draws a place in a cell by the filtered weight. `u` is in [0, 1).
SHARED_FN MapPlace samplePlace(const MapCorners corners, const uint column, const uint row, const uint height,
                               const vec2 u) {
    const float upper = corners.upperLeft.w + corners.upperRight.w;
    const float lower = corners.lowerLeft.w + corners.lowerRight.w;
    // The halves of cells do not depend on `down`.
    const float inCell = sampleLinear(upper, lower, u.y);
    const float inHalf = u.y * 0.5f;
    const float down = row == 0u ? 0.5f + inHalf : row == height ? inHalf : inCell;
    const float left = blend(corners.upperLeft.w, corners.lowerLeft.w, down);
    const float right = blend(corners.upperRight.w, corners.lowerRight.w, down);
    return MapPlace(column, row, sampleLinear(left, right, u.x), down);
}

SHARED_END
#endif
