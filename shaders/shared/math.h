// SPDX-License-Identifier: MIT
// Elementary functions that drivers may only approximate, made of operations that round the same on host and
// device. Errors are in ulps of the exact result; tests/shading measures each over its domain. Results too
// small for a normal float are 0, because devices may flush denormals.
#ifndef METAMARCH_SHARED_MATH_H
#define METAMARCH_SHARED_MATH_H
#include "interop.h"

SHARED_BEGIN

const float kPi = 3.14159265358979324f;
const float kTwoPi = 6.28318530717958648f;
const float kHalfPi = 1.57079632679489662f;
const float kInvPi = 0.318309886183790672f;

SHARED_FN float squared(const float x) { return x * x; }

SHARED_FN float dotProduct(const vec3 a, const vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

SHARED_FN vec3 crossProduct(const vec3 a, const vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// normalize() may be approximate; this function is not.
SHARED_FN vec3 unitVector(const vec3 v) {
    const float squaredLength = v.x * v.x + v.y * v.y + v.z * v.z;
    const vec3 unit = v / sqrt(squaredLength);
    return unit;
}

// Linear interpolation; returns exactly a for t = 0 and exactly b for t = 1.
SHARED_FN float blend(const float a, const float b, const float t) { return a * (1.0f - t) + b * t; }
SHARED_FN vec3 blend3(const vec3 a, const vec3 b, const float t) { return a * (1.0f - t) + b * t; }

// Rec. 709 luminance of linear RGB.
SHARED_FN float luminance(const vec3 color) {
    return 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z;
}

SHARED_FN float largest(const vec3 v) { return max(max(v.x, v.y), v.z); }
SHARED_FN float smallest(const vec3 v) { return min(min(v.x, v.y), v.z); }

// Returns cosine and sine of `turns` * 2 pi, each within 3 ulps for |turns| <= 2^20. The range reduction is
// exact.
SHARED_FN vec2 circlePoint(const float turns) {
    const float quadrant = floor(turns * 4.0f + 0.5f);
    const float r = turns - quadrant * 0.25f; // exact, |r| <= 1/8
    const float r2 = r * r;
    const float sine = r * kTwoPi + r * r2 * (-41.3416723327f + r2 * (81.5937667162f + r2 * -75.4456033503f));
    const float cosine =
        1.0f + r2 * (-19.7392086816f + r2 * (64.9393218472f + r2 * (-85.4432362977f + r2 * 59.2292441963f)));
    const uint index = uint(int(quadrant)) & 3u;
    const bool isSwapped = (index & 1u) != 0u;
    const float x = isSwapped ? sine : cosine;
    const float y = isSwapped ? cosine : sine;
    return vec2(index == 1u || index == 2u ? -x : x, index >= 2u ? -y : y);
}

// e^x within 2 ulps. Returns 0 below kMinExponent, and for x above kMaxExponent the value at kMaxExponent.
const float kMinExponent = -87.0f;
const float kMaxExponent = 88.0f;
SHARED_FN float exponential(const float x) {
    const float bounded = min(max(x, kMinExponent), kMaxExponent);
    const float binary = floor(bounded * 1.44269504089f + 0.5f);
    // ln 2 as a sum of two parts; the first has so few bits that its multiples are exact.
    const float r = (bounded - binary * 0.693359375f) + binary * 2.12194440055e-4f;
    const float result =
        1.0f + (r + r * r *
                        (0.499999934478f +
                         r * (0.166665206318f +
                              r * (0.041668388031f + r * (0.00836871687526f + r * 0.00138145995531f)))));
    const float scaled = result * uintBitsToFloat(uint(int(binary) + 127) << 23u);
    return x < kMinExponent ? 0.0f : scaled;
}

// The natural logarithm of a positive normal number, within 2 ulps. After W. J. Cody, W. Waite, "Software
// Manual for the Elementary Functions", 1980: near 1 the leading term is x - 1, exactly.
const uint kHalfRootBits = 0x3f3504f3u; // the bits of sqrt(1/2)
SHARED_FN float logarithm(const float x) {
    const uint bits = floatBitsToUint(x) - kHalfRootBits; // puts the significand into [sqrt(1/2), sqrt(2))
    const float binary = float(int(bits) >> 23);
    const float significand = uintBitsToFloat((bits & 0x007fffffu) + kHalfRootBits);
    const float f = significand - 1.0f;
    const float s = f / (2.0f + f);
    const float z = s * s;
    const float tail =
        z * (0.666666656455f + z * (0.40000335191f + z * (0.285373085382f + z * 0.235821513682f)));
    const float bend = 0.5f * f * f;
    const float lowTerms = s * (bend + tail) + binary * -2.12194440055e-4f;
    const float result = binary * 0.693359375f + (f - (bend - lowTerms));
    return result;
}

// base^exponent for a positive normal base. The relative error is at most 2^-22 * (1 + |exponent * ln base|).
SHARED_FN float power(const float base, const float exponent) {
    return exponential(exponent * logarithm(base));
}

// The angle of (x, y) in [-pi, pi], within 3 ulps; 0 for the origin.
SHARED_FN float arcTangent(const float y, const float x) {
    const float far = max(abs(x), abs(y));
    const float near = min(abs(x), abs(y));
    // tan(angle - pi/4) = (tan(angle) - 1) / (tan(angle) + 1) maps the upper half of the octant to values
    // near 0.
    const bool isUpper = near > 0.414213562373f * far;
    const float above = isUpper ? near - far : near;
    const float below = isUpper ? near + far : far;
    const float a = above / (below == 0.0f ? 1.0f : below);
    const float z = a * a;
    const float bend =
        a * z *
        (-0.333333155053f +
         z * (0.199984894372f + z * (-0.142438487575f + z * (0.105960017228f + z * -0.0608345380375f))));
    const float inOctant = isUpper ? 0.785398163397f + (a + bend) : a + bend;
    const float inQuadrant = abs(y) > abs(x) ? kHalfPi - inOctant : inOctant;
    const float inHalf = x < 0.0f ? kPi - inQuadrant : inQuadrant;
    return y < 0.0f ? -inHalf : inHalf;
}

// The angle in [0, pi] whose cosine is x, within 4 ulps. x is clamped to [-1, 1].
SHARED_FN float arcCosine(const float x) {
    const float cosine = min(max(x, -1.0f), 1.0f);
    return arcTangent(sqrt((1.0f - cosine) * (1.0f + cosine)), cosine);
}

// Two unit vectors that form an orthonormal basis with `normal`.
struct Basis {
    vec3 tangent;
    vec3 bitangent;
};

// T. Duff, J. Burgess, P. Christensen, C. Hery, A. Kensler, M. Liani, R. Villemin, "Building an Orthonormal
// Basis, Revisited", JCGT 6(1), 2017.
SHARED_FN Basis basisAround(const vec3 normal) {
    const float side = normal.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (side + normal.z);
    const float b = normal.x * normal.y * a;
    const vec3 tangent = vec3(1.0f + side * normal.x * normal.x * a, side * b, -side * normal.x);
    const vec3 bitangent = vec3(b, side + normal.y * normal.y * a, -normal.y);
    return Basis(tangent, bitangent);
}

SHARED_END
#endif
