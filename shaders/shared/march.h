// SPDX-License-Identifier: MIT
// The steps of the march through the meta table. The loops are in traversal/meta_table.glsl and its CPU twin.
#ifndef METAMARCH_SHARED_MARCH_H
#define METAMARCH_SHARED_MARCH_H
#include "ray.h"

SHARED_BEGIN

// Returns the cell at t along the ray, clamped to [lo, hi).
SHARED_FN ivec3 cellAt(const Ray ray, const float t, const ivec3 lo, const ivec3 hi) {
    const vec3 p = ray.start + ray.stride * t;
    return ivec3(clamp(floor(p), vec3(lo), vec3(hi - 1))); // clamped as floats: every value converts
}

struct BoxExit {
    float t;    // at which the ray leaves the box
    ivec3 cell; // the first cell behind the box; may be outside the lattice
};

// Leaves the box [lo, hi), which contains `cell`. On the axis whose plane comes first, by ordered comparison,
// the cell moves on by at least one, to the cell beyond the integer plane. On the other axes it never moves
// back. A float position could move back because of rounding, and then the march would not end.
SHARED_FN BoxExit leaveBox(const Ray ray, const ivec3 lo, const ivec3 hi, const ivec3 cell) {
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    const vec3 tPlane = (vec3(mix(lo, hi, upward)) - ray.start) * ray.invStride;
    const bool exitX = tPlane.x <= tPlane.y && tPlane.x <= tPlane.z;
    const bool exitY = !exitX && tPlane.y <= tPlane.z;
    const float t = exitX ? tPlane.x : exitY ? tPlane.y : tPlane.z;

    const ivec3 onward = cellAt(ray, t, mix(lo, cell, upward), mix(cell + 1, hi, upward));
    const ivec3 beyond = mix(lo - 1, hi, upward);
    return BoxExit(t, ivec3(exitX ? beyond.x : onward.x, exitY ? beyond.y : onward.y,
                            exitX || exitY ? onward.z : beyond.z));
}

SHARED_FN bool isInLattice(const ivec3 cell, const uvec3 resolution) {
    return uint(cell.x) < resolution.x && uint(cell.y) < resolution.y && uint(cell.z) < resolution.z;
}

SHARED_END
#endif
