// SPDX-License-Identifier: MIT
// The point that a ray hit, and rays that leave it.
#ifndef METAMARCH_SHARED_HIT_POINT_H
#define METAMARCH_SHARED_HIT_POINT_H
#include "triangle.h"

SHARED_BEGIN

// Returns the barycentric weights of the hit; they sum to 1. The ray must hit the triangle. They are computed
// without cancellation, as intersectTriangle does in its second attempt.
SHARED_FN vec3 cornerWeights(const Ray ray, const vec3 v0, const vec3 v1, const vec3 v2) {
    const vec3 a = shearCorner(ray, v0);
    const vec3 b = shearCorner(ray, v1);
    const vec3 c = shearCorner(ray, v2);
    const float u = abs(differenceOfProducts(c.x, b.y, c.y, b.x));
    const float v = abs(differenceOfProducts(a.x, c.y, a.y, c.x));
    const float w = abs(differenceOfProducts(b.x, a.y, b.y, a.x));
    const float sum = u + v + w;
    const float scale = 1.0f / (sum > 0.0f ? sum : 1.0f);
    return sum > 0.0f ? vec3(u * scale, v * scale, w * scale) : vec3(1.0f, 0.0f, 0.0f);
}

// Returns the float next to x in the direction of the sign of `towards`; if `towards` is 0, returns x.
SHARED_FN float nextTowards(const float x, const float towards) {
    if (towards == 0.0f) {
        return x;
    }
    const bool isUp = towards > 0.0f;
    const uint bits = floatBitsToUint(x);
    const uint smallest = isUp ? 0x00800000u : 0x80800000u; // normal: devices flush denormals
    const bool isTiny = (bits & 0x7fffffffu) < 0x00800000u;
    const bool isAway = (x > 0.0f) == isUp;
    return uintBitsToFloat(isTiny ? smallest : isAway ? bits + 1u : bits - 1u);
}

struct SurfacePoint {
    vec3 position; // on the triangle, up to rounding
    vec3 normal;   // geometric normal on the front side, unit length
    float lift;    // a point moved by this along the normal is off the triangle, despite rounding
};

// The triangle test may see a triangle away from its true place by 9 ulps of its longest edge (triangle.h).
// kTestError is three times that, in units of the longest edge: a ray that starts so far away misses it.
const float kTestError = 1.6093254e-6f; // 27 * 2^-24
// The rounding errors of adding an offset to a corner, and of adding the lift.
const float kPointError = 1.7881393e-7f; // 3 * 2^-24

// The error bounds follow M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition, 2023,
// section 6.8. The position is computed relative to the first corner, so only the last addition has a
// rounding error that grows with the distance of the scene from the origin.
SHARED_FN SurfacePoint makeSurfacePoint(const TriangleRecord triangle, const vec3 weights) {
    const vec3 e1 = triangle.v1 - triangle.v0;
    const vec3 e2 = triangle.v2 - triangle.v0;
    const vec3 position = triangle.v0 + (e1 * weights.y + e2 * weights.z);
    const vec3 scaled = scaledNormal(triangle.v0, triangle.v1, triangle.v2);
    const vec3 normal = unitVector(scaled / largest(abs(scaled)));
    const vec3 reach = max(max(abs(e1), abs(e2)), abs(e1 - e2));
    const vec3 size = abs(position);
    const float rounding =
        kPointError * (abs(normal.x) * size.x + abs(normal.y) * size.y + abs(normal.z) * size.z);
    return SurfacePoint(position, normal, rounding + kTestError * largest(reach));
}

// Returns the origin of a ray that leaves the point on the side of `towards`. It is off the triangle by at
// least the lift.
SHARED_FN vec3 offsetPoint(const SurfacePoint point, const vec3 towards) {
    const float side = dotProduct(towards, point.normal) < 0.0f ? -1.0f : 1.0f;
    const vec3 away = point.normal * side;
    const vec3 moved = point.position + away * point.lift;
    return vec3(nextTowards(moved.x, away.x), nextTowards(moved.y, away.y), nextTowards(moved.z, away.z));
}

SHARED_END
#endif
