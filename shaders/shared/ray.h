// SPDX-License-Identifier: MIT
// Ray set-up: computes once everything that traversals and triangle tests need of a ray, with the same bits
// on host and device.
//
// The origin is first moved to just before the scene box. From there on, every coordinate and therefore every
// rounding error is bounded by the size of the box, no matter how far away the camera is.
// `src/accel/README.md` bases its proof that no hit is lost on this.
#ifndef METAMARCH_SHARED_RAY_H
#define METAMARCH_SHARED_RAY_H
#include "math.h"
#include "scene_layout.h"

SHARED_BEGIN

const float kFarthest = 3.0e38f; // replaces infinity, which shaders need not support

// Relative tolerance for distances to the box, for any device that Vulkan allows: src/accel/README.md,
// "Distances to the box".
const float kBoxRounding = 1.9073486328125e-6f; // 2^-19

// A component of a direction below this fraction of the largest one counts as zero. A zero gets the inverse
// of this fraction, with its own sign. So inverses are finite, and products stay out of the denormals that
// devices may flush. Over the length of the scene box this moves a ray by at most 2^-16 of a float step.
const float kSmallestComponent = 9.09494701772928238e-13f; // 2^-40

// Limits of directions and origins; products of three values within them stay finite. A ray outside them hits
// nothing.
const float kMinDirection = 9.09494701772928238e-13f;  // 2^-40
const float kMaxDirection = 1.099511627776e12f;        // 2^40
const float kMaxCoordinate = 1.152921504606846976e18f; // 2^60

// t is in units of the length of dir and counts from `origin`; add `shift` for the t from the caller's
// origin.
struct Ray {
    vec3 origin; // world space, in or just before the scene box
    float shift;
    vec3 dir;   // need not have unit length; components that count as zero are zero
    float tMin; // a hit has tMin < t <= tMax; if tMax < tMin, the ray hits nothing
    float tMax;

    // Lattice space: one unit is one cell; t is unchanged.
    vec3 start;
    vec3 stride;
    vec3 invStride; // finite, never zero; has the sign of dir, even of a zero
    float tNear;    // t at which the ray enters the lattice
    float tFar;     // t at which the ray leaves the lattice

    // The triangle test looks along the axis of dir's largest component: Woop, Benthin, Wald 2013, section 3.
    uint lastAxis; // axis of that component
    vec3 shear;    // dir.x / dir.z, dir.y / dir.z, 1 / dir.z, where z stands for that axis
    float extent;  // longest side of the scene box, world units
};

SHARED_FN vec3 inOrder(const vec3 v, const uint lastAxis) {
    return vec3(lastAxis == 0u ? v.z : v.x, lastAxis == 1u ? v.z : v.y,
                lastAxis == 0u   ? v.x
                : lastAxis == 1u ? v.y
                                 : v.z);
}

SHARED_FN vec3 clearSmall(const vec3 v, const float smallestMagnitude) {
    return vec3(abs(v.x) < smallestMagnitude ? 0.0f : v.x, abs(v.y) < smallestMagnitude ? 0.0f : v.y,
                abs(v.z) < smallestMagnitude ? 0.0f : v.z);
}

SHARED_FN float finiteInverse(const float x, const float smallestMagnitude) {
    const float magnitude = max(abs(x), smallestMagnitude);
    return (floatBitsToInt(x) < 0 ? -1.0f : 1.0f) / magnitude;
}

// Returns false for NaN, whatever the compiler assumes: it compares the bits.
SHARED_FN bool isWithin(const float x, const float limit) {
    return (floatBitsToUint(x) & 0x7fffffffu) <= floatBitsToUint(limit);
}
SHARED_FN bool isWithin(const vec3 v, const float limit) {
    return isWithin(v.x, limit) && isWithin(v.y, limit) && isWithin(v.z, limit);
}

// Returns (near, far) of the line's intersection with the lattice box; far includes the rounding tolerance.
SHARED_FN vec2 crossLattice(const vec3 start, const vec3 invStride, const uvec3 resolution) {
    const vec3 t0 = (vec3(0.0f) - start) * invStride;
    const vec3 t1 = (vec3(resolution) - start) * invStride;
    const float far = smallest(max(t0, t1)) * (1.0f + kBoxRounding);
    return vec2(largest(min(t0, t1)), far);
}

SHARED_FN Ray makeRay(const Lattice lattice, const vec3 origin, const float tMin, const vec3 dir,
                      const float tMax) {
    Ray ray;
    const float dirSize = largest(abs(dir));
    const bool sane = isWithin(dir, kMaxDirection) && dirSize >= kMinDirection &&
                      isWithin(origin, kMaxCoordinate) && isWithin(tMin, kFarthest) &&
                      isWithin(tMax, kFarthest);

    const float floorSize = dirSize * kSmallestComponent;
    const vec3 invDir = vec3(finiteInverse(dir.x, floorSize), finiteInverse(dir.y, floorSize),
                             finiteInverse(dir.z, floorSize));
    ray.dir = clearSmall(dir, floorSize);
    const vec3 stride = ray.dir * lattice.cellsPerUnit;
    const vec3 invStride = invDir / lattice.cellsPerUnit;
    ray.stride = stride;
    ray.invStride = invStride;

    // Move the origin towards the box, but stop short of it by the rounding error of the distance.
    const vec3 given = (origin - lattice.origin) * lattice.cellsPerUnit;
    const vec2 reach = crossLattice(given, invStride, lattice.resolution);
    const float shift = max(reach.x * (1.0f - kBoxRounding), 0.0f);
    const vec3 moved = origin + ray.dir * shift;
    ray.shift = shift;
    ray.origin = shift > 0.0f ? moved : origin;
    const vec3 start = (ray.origin - lattice.origin) * lattice.cellsPerUnit;
    ray.start = start;
    const vec2 crossing = crossLattice(start, invStride, lattice.resolution);
    ray.tNear = max(crossing.x, 0.0f);
    ray.tFar = crossing.y;

    const float tMinHere = max(tMin - shift, 0.0f);
    const float tMaxHere = tMax - shift;
    ray.tMin = sane ? tMinHere : 0.0f; // never NaN, so that tMax < tMin identifies a ray that hits nothing
    // Geometry keeps a distance from the faces of the lattice, so a ray that only grazes them hits nothing.
    ray.tMax = sane && reach.x <= reach.y && ray.tNear <= ray.tFar ? tMaxHere : -1.0f;

    const vec3 size = abs(dir);
    const uint last = size.x >= size.y ? (size.x >= size.z ? 0u : 2u) : (size.y >= size.z ? 1u : 2u);
    ray.lastAxis = last;
    const vec3 along = inOrder(ray.dir, last);
    const vec3 shear = vec3(along.x, along.y, 1.0f) / along.z;
    ray.shear = shear;
    ray.extent = lattice.extent;
    return ray;
}

// Returns the part of the ray behind a hit at t. Traversals of it begin at the hit, so a ray that passes many
// surfaces does not visit the same leaves again.
SHARED_FN Ray rayBehind(const Ray ray, const float t) {
    Ray rest = ray;
    rest.tMin = t;
    rest.tNear = max(ray.tNear, t);
    return rest;
}

SHARED_END
#endif
