// SPDX-License-Identifier: MIT
// The format of rays and hits for the kernel `rays` and the judges.
#ifndef METAMARCH_SHARED_RAY_QUERY_H
#define METAMARCH_SHARED_RAY_QUERY_H
#include "triangle.h"

SHARED_BEGIN

// One ray. A hit has tMin < t <= tMax; the unit of t is the length of dir.
struct RayQuery {
    vec3 origin;
    float tMin;
    vec3 dir;
    float tMax;
};

struct RayResult {
    float t;         // of the hit; meaningless for a miss
    uint triangleId; // kNoTriangle for a miss
    uint steps;      // number of steps or node visits
    uint tests;      // number of triangle tests
};

const uint kNoRecord = 0xffffffffu; // the record of a ray that hits nothing

struct RaysPush {
    uint first; // traces the rays [first, end)
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
