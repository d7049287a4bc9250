// SPDX-License-Identifier: MIT
// Rays and hits as the kernel `rays` and the judges exchange them.
#ifndef METAMARCH_SHARED_RAY_QUERY_H
#define METAMARCH_SHARED_RAY_QUERY_H
#include "triangle.h"

SHARED_BEGIN

// One ray: a hit has tMin < t <= tMax, t in lengths of dir.
struct RayQuery {
    vec3 origin;
    float tMin;
    vec3 dir;
    float tMax;
};

struct RayResult {
    float t;         // of the hit; meaningless for a miss
    uint triangleId; // kNoTriangle for a miss
    uint steps;      // look-ups of the march, or nodes visited
    uint tests;      // triangle tests
};

const uint kNoRecord = 0xffffffffu; // the record of a ray that hits nothing

struct RaysPush {
    uint first; // of the rays to trace
    uint end;
};

SHARED_FN RayResult rayResult(const Ray ray, const Hit hit, const uint steps, const uint tests) {
    const float t = ray.shift + hit.t;
    return RayResult(t, hit.triangleId, steps, tests);
}

SHARED_ASSERT_SIZE(RayQuery, 32)
SHARED_ASSERT_OFFSET(RayQuery, tMin, 12)
SHARED_ASSERT_OFFSET(RayQuery, dir, 16)
SHARED_ASSERT_OFFSET(RayQuery, tMax, 28)
SHARED_ASSERT_SIZE(RayResult, 16)
SHARED_ASSERT_OFFSET(RayResult, triangleId, 4)
SHARED_ASSERT_OFFSET(RayResult, steps, 8)
SHARED_ASSERT_OFFSET(RayResult, tests, 12)
SHARED_ASSERT_SIZE(RaysPush, 8)
SHARED_ASSERT_OFFSET(RaysPush, end, 4)

SHARED_END
#endif
