// SPDX-License-Identifier: MIT
// Computes the functions of math.h and sobol.h for one input, on CPU and device.
#ifndef METAMARCH_TESTS_SHADING_MATH_CASE_H
#define METAMARCH_TESTS_SHADING_MATH_CASE_H
#include "metamarch/shared/math.h"
#include "metamarch/shared/sobol.h"

SHARED_BEGIN

struct MathCase {
    vec3 direction; // unit length
    float x;        // in [-1, 1]
    uint pixelX;
    uint pixelY;
    uint index;
    uint dimension;
};

struct MathAnswer {
    vec3 tangent;
    float exponential;
    vec3 bitangent;
    float logarithm;
    float cosine;
    float sine;
    float power;
    float arcTangent;
    float arcCosine;
    float point;
    float pointX;
    float pointY;
};

SHARED_FN MathAnswer answer(const MathCase asked) {
    const Basis basis = basisAround(asked.direction);
    const vec2 circle = circlePoint(asked.x * 100.0f);
    const float size = exponential(asked.x * 90.0f);
    const PixelSample at = makePixelSample(asked.pixelX, asked.pixelY, asked.index, 9u);
    const vec2 point = sample2d(at, asked.dimension);
    return MathAnswer(basis.tangent, size, basis.bitangent, logarithm(max(size, 1e-37f)), circle.x, circle.y,
                      power(abs(asked.x) + 0.01f, asked.direction.x * 10.0f),
                      arcTangent(asked.direction.z, asked.direction.x), arcCosine(asked.x),
                      sample1d(at, asked.dimension), point.x, point.y);
}

SHARED_ASSERT_SIZE(MathCase, 32)
SHARED_ASSERT_SIZE(MathAnswer, 64)

SHARED_END
#endif
