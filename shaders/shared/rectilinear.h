// SPDX-License-Identifier: MIT
// The lattice of uneven cells and the steps through it. The loops are in traversal/rectilinear_table.glsl and
// its CPU twin.
#ifndef METAMARCH_SHARED_RECTILINEAR_H
#define METAMARCH_SHARED_RECTILINEAR_H
#include "ray.h"

SHARED_BEGIN

// Planes across each axis, in the space of the scene's lattice, and the cells between them. One array holds
// the planes of all axes. Each axis has resolution + 1 planes in ascending order, followed by kFarthest,
// which ends every search. A second array divides each axis into buckets of equal length; for each bucket it
// holds the cell at which a search begins.
struct Rectilinear {
    vec3 bucketsPerUnit;
    uint cellCount;
    uvec3 resolution; // 1..kMaxLatticeResolution
    uint padding0;
    uvec3 firstPlane;
    uint padding1;
    uvec3 firstBucket;
    uint padding2;
    uvec3 lastBucket; // of each axis, counted from its first bucket
    uint padding3;
};

// Returns the bucket of a position. It never decreases as the position grows, so planes of lower buckets are
// before the position.
SHARED_FN uint bucketAt(const float position, const float bucketsPerUnit, const uint lastBucket) {
    // Clamp before the conversion, because not every float fits an integer.
    const float bucket = floor(clamp(position * bucketsPerUnit, 0.0f, float(lastBucket)));
    return uint(bucket);
}

// Returns a position in lattice space. It stays below kFarthest, at which searches end.
SHARED_FN vec3 positionAt(const Ray ray, const float t) {
    const vec3 position = min(ray.start + ray.stride * t, vec3(kMaxCoordinate));
    return position;
}

struct PlaneExit {
    float t;   // at which the ray leaves the box
    uint axis; // axis of the plane that the ray meets first, by ordered comparison
};

// Leaves a box through one of its three far planes.
SHARED_FN PlaneExit firstOf(const Ray ray, const vec3 farPlanes) {
    const vec3 tPlane = (farPlanes - ray.start) * ray.invStride;
    const bool exitX = tPlane.x <= tPlane.y && tPlane.x <= tPlane.z;
    const bool exitY = !exitX && tPlane.y <= tPlane.z;
    const float t = exitX ? tPlane.x : exitY ? tPlane.y : tPlane.z;
    return PlaneExit(t, exitX ? 0u : exitY ? 1u : 2u);
}

// Returns the cell behind the exit from the box [lo, hi), which contains `cell`. `found` is the cell that a
// search found for the exit point. On the exit's axis, the cell is the one beyond the box, so it moves on by
// at least one. On the other axes it never moves back. A position could move back because of rounding, and
// then the march would not end.
SHARED_FN ivec3 cellBehind(const Ray ray, const ivec3 lo, const ivec3 hi, const ivec3 cell, const ivec3 found,
                           const uint exitAxis) {
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    const ivec3 inBox = clamp(found, lo, hi - 1);
    const ivec3 onward = mix(min(inBox, cell), max(inBox, cell), upward);
    const ivec3 beyond = mix(lo - 1, hi, upward);
    return ivec3(exitAxis == 0u ? beyond.x : onward.x, exitAxis == 1u ? beyond.y : onward.y,
                 exitAxis == 2u ? beyond.z : onward.z);
}

SHARED_ASSERT_SIZE(Rectilinear, 80)
SHARED_ASSERT_OFFSET(Rectilinear, cellCount, 12)
SHARED_ASSERT_OFFSET(Rectilinear, resolution, 16)
SHARED_ASSERT_OFFSET(Rectilinear, firstPlane, 32)
SHARED_ASSERT_OFFSET(Rectilinear, firstBucket, 48)
SHARED_ASSERT_OFFSET(Rectilinear, lastBucket, 64)
SHARED_ASSERT_OFFSET(Rectilinear, padding3, 76)

SHARED_END
#endif
