// SPDX-License-Identifier: MIT
// The triangle test of every traversal, on host and device.
#ifndef METAMARCH_SHARED_TRIANGLE_H
#define METAMARCH_SHARED_TRIANGLE_H
#include "ray.h"

SHARED_BEGIN

struct Hit {
    float t;         // from ray.origin, in lengths of ray.dir
    uint triangleId; // kNoTriangle for a miss
};

// Replaces the number of steps if the driver ended the traversal before it was done.
const uint kCutShort = 0xffffffffu;

const float kNoHit = -1.0f; // every real t is positive

// Returns x with the upper 12 of the 24 bits of its significand. A mask is as exact as rounding and needs one
// instruction instead of three.
SHARED_FN float upperHalf(const float x) { return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u); }

// Returns the exact rounding error of the product p = a * b. T. J. Dekker, "A floating-point technique for
// extending the available precision", Numerische Mathematik 18, 1971.
SHARED_FN float productError(const float a, const float b, const float p) {
    const float aHigh = upperHalf(a);
    const float aLow = a - aHigh;
    const float bHigh = upperHalf(b);
    const float bLow = b - bHigh;
    const float error = ((aHigh * bHigh - p) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
    return error;
}

// Returns a * b - c * d within a few ulps of the result, even if the two products nearly cancel.
SHARED_FN float differenceOfProducts(const float a, const float b, const float c, const float d) {
    const float ab = a * b;
    const float cd = c * d;
    const float difference = (ab - cd) + (productError(a, b, ab) - productError(c, d, cd));
    return difference;
}

// Returns the bits of |x|, whose order as integers is that of the floats. A max of integers takes one
// instruction, a max of floats three, because it must treat NaN.
SHARED_FN uint magnitudeBits(const float x) { return floatBitsToUint(x) & 0x7fffffffu; }

// Returns true if one number is negative and another is positive. Zeros of either sign are neither.
SHARED_FN bool haveBothSigns(const float u, const float v, const float w) {
    const uint kMinusZero = 0x80000000u;
    const uint largestBits = max(max(floatBitsToUint(u), floatBitsToUint(v)), floatBitsToUint(w));
    const int largestInt = max(max(floatBitsToInt(u), floatBitsToInt(v)), floatBitsToInt(w));
    return largestBits > kMinusZero && largestInt > 0;
}

// Shears a corner so that the ray becomes the z axis; z is the corner's depth.
SHARED_FN vec3 shearCorner(const Ray ray, const vec3 corner) {
    const vec3 p = inOrder(corner - ray.origin, ray.lastAxis);
    const vec3 sheared = vec3(p.x - ray.shear.x * p.z, p.y - ray.shear.y * p.z, p.z);
    return sheared;
}

// Returns the t at which the ray hits the triangle, or kNoHit.
// S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
//
// The test is watertight: the shear moves a vertex to the same point for every triangle that shares it. The
// sign of a rounded a * b - c * d is never wrong, because rounding is monotone. It may be zero where the
// exact result is not, but zero counts as inside. So of two triangles that share an edge, at least one is
// hit.
//
// The hit is near the triangle: the weights U, V, W have the same sign, so t lies between the depths of the
// three vertices. The ray's point at t is at most about 9 ulps of L^3 / |det| away from the triangle, where L
// is the largest coordinate of the sheared vertices. If that could exceed 9 ulps of the scene box, the
// weights are computed again without cancellation. src/accel/README.md says who relies on this.
SHARED_FN float intersectTriangle(const Ray ray, const vec3 v0, const vec3 v1, const vec3 v2) {
    const vec3 a = shearCorner(ray, v0);
    const vec3 b = shearCorner(ray, v1);
    const vec3 c = shearCorner(ray, v2);
    float u = c.x * b.y - c.y * b.x;
    float v = a.x * c.y - a.y * c.x;
    float w = b.x * a.y - b.y * a.x;
    if (haveBothSigns(u, v, w)) {
        return kNoHit;
    }
    float det = u + v + w;

    const float reach = uintBitsToFloat(
        max(max(max(magnitudeBits(a.x), magnitudeBits(a.y)), max(magnitudeBits(b.x), magnitudeBits(b.y))),
            max(magnitudeBits(c.x), magnitudeBits(c.y))));
    if (!(squared(reach) * reach <= abs(det) * ray.extent)) {
        u = differenceOfProducts(c.x, b.y, c.y, b.x);
        v = differenceOfProducts(a.x, c.y, a.y, c.x);
        w = differenceOfProducts(b.x, a.y, b.y, a.x);
        if (haveBothSigns(u, v, w)) {
            return kNoHit;
        }
        det = u + v + w;
    }
    if (det == 0.0f) {
        return kNoHit; // seen edge-on; its neighbours cover the same area
    }

    const float depth = (u * a.z + v * b.z + w * c.z) * ray.shear.z;
    const float t = depth / det;
    return t > ray.tMin ? t : kNoHit;
}

// A triangle whose scaledNormal is smaller than this in every component is degenerate: floats cannot hold the
// direction of its normal. It is left out of every structure.
const float kSmallestNormal = 7.88860905221011805e-31f; // 2^-100

// Returns the geometric normal times twice the area. It is on the side from which v0, v1, v2 are in
// counter-clockwise order.
SHARED_FN vec3 scaledNormal(const vec3 v0, const vec3 v1, const vec3 v2) {
    const vec3 e1 = v1 - v0;
    const vec3 e2 = v2 - v0;
    const vec3 normal = vec3(e1.y * e2.z - e1.z * e2.y, e1.z * e2.x - e1.x * e2.z, e1.x * e2.y - e1.y * e2.x);
    return normal;
}

// Orders hits by t, and hits with the same t by triangle id. So the closest hit does not depend on the order
// in which triangles are tested.
SHARED_FN bool isCloser(const float t, const uint triangleId, const Hit best) {
    return t < best.t || (t == best.t && triangleId < best.triangleId);
}

SHARED_END
#endif
