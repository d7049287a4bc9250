// Ray set-up: everything a traversal and a triangle test need of a ray, computed once, the same bits on both
// sides.
//
// The origin is first moved to just before the scene box. From there on every coordinate, and so every
// rounding error, is bounded by the size of the box and no longer by how far away the camera stands;
// `accel/README.md` builds its proof that no hit is lost on that.
#ifndef METAMARCH_SHARED_RAY_H
#define METAMARCH_SHARED_RAY_H
#include "math.h"
#include "scene_layout.h"

SHARED_BEGIN

const float kFarthest = 3.0e38f; // stands for infinity, which shaders need not support

// Room for rounding in distances to the box, relative: 16 ulps. The slab test makes at most 6 roundings.
const float kBoxRounding = 9.5367431640625e-7f; // 2^-20

// A component of a direction below this fraction of the largest one counts as zero, and a zero has the
// inverse that this fraction would have, with its own sign: so inverses are finite, and products stay clear
// of the denormals that devices may flush. Over the length of the scene box it moves a ray by 2^-16 of a
// float step at most.
const float kSmallestComponent = 9.09494701772928238e-13f; // 2^-40

// Directions and origins outside these make a ray that hits nothing: products of three of them stay finite.
const float kMinDirection = 9.09494701772928238e-13f;  // 2^-40
const float kMaxDirection = 1.099511627776e12f;        // 2^40
const float kMaxCoordinate = 1.152921504606846976e18f; // 2^60

// Every t counts lengths of dir from `origin`; add `shift` for the distance from the origin that was asked
// for.
struct Ray {
    vec3 origin; // world space, in or just before the scene box
    float shift;
    vec3 dir;   // need not be of unit length; components that count as zero are zero
    float tMin; // a hit has tMin < t <= tMax; tMax < tMin: the ray meets nothing
    float tMax;

    // Lattice space: one unit is one cell, t is unchanged.
    vec3 start;
    vec3 stride;
    vec3 invStride; // finite, never zero; its sign is the sign of dir, also of a zero
    float tNear;    // where the ray enters and leaves the lattice
    float tFar;

    // The triangle test's view along the axis in which dir is largest: Woop, Benthin, Wald 2013, section 3.
    uint lastAxis; // that axis
    vec3 shear;    // dir.x / dir.z, dir.y / dir.z, 1 / dir.z, with that axis as z
    float extent;  // longest side of the scene box
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

// False for NaN, whatever the compiler thinks of it: works on the bits.
SHARED_FN bool isWithin(const float x, const float limit) {
    return (floatBitsToUint(x) & 0x7fffffffu) <= floatBitsToUint(limit);
}
SHARED_FN bool isWithin(const vec3 v, const float limit) {
    return isWithin(v.x, limit) && isWithin(v.y, limit) && isWithin(v.z, limit);
}

// Where the line through `start` crosses the lattice box, as (near, far); far carries the room for rounding.
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

    // Move the origin to the box, staying before it by the rounding of the distance.
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
    ray.tMin = sane ? tMinHere : 0.0f; // never NaN, so that tMax < tMin shows that the ray meets nothing
    // Geometry keeps off the faces of the lattice, so a ray that only grazes them meets nothing.
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

SHARED_END
#endif
