// SPDX-License-Identifier: MIT
// The functions of math.h against long double, over their whole domains.
#include "metamarch/shared/math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace metamarch {
namespace {

constexpr int kSamples = 400'000;

// Returns the error in ulps of the exact value as a float; below the normal floats, in ulps of the smallest
// one.
double ulps(float value, long double exact) {
    const int exponent = std::max(std::ilogb(exact), std::numeric_limits<float>::min_exponent - 1) - 23;
    return static_cast<double>(std::abs(static_cast<long double>(value) - exact) /
                               std::ldexp(1.0L, exponent));
}

// Calls `visit` with floats of [lo, hi]: the ends, uniformly spaced values, and values of every magnitude.
template <class Visit>
void forDomain(float lo, float hi, Visit visit) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> even(lo, hi);
    std::uniform_real_distribution<float> magnitude(std::log(1e-30f), std::log(std::max(-lo, hi)));
    visit(lo);
    visit(hi);
    for (int i = 0; i < kSamples; ++i) {
        visit(even(random));
        const float size = std::exp(magnitude(random));
        for (const float x : {size, -size}) {
            if (x >= lo && x <= hi) {
                visit(x);
            }
        }
    }
}

struct WorstError {
    double ulps = 0.0;
    float at = 0.0f;

    void add(float x, float value, long double exact) {
        const double error = metamarch::ulps(value, exact);
        if (!(error <= ulps)) { // NaN counts as the worst
            ulps = error;
            at = x;
        }
    }
};

TEST(SharedMath, circlePointKeepsItsErrorNearTheAxes) {
    WorstError cosine;
    WorstError sine;
    // sinl is inexact at quadrants because pi is rounded. Reduce the argument first, as the function does.
    forDomain(-1.0f, 1.0f, [&](float turns) {
        const vec2 point = circlePoint(turns);
        const long double r = turns - std::nearbyint(4.0L * turns) / 4.0L;
        const int quadrant = static_cast<int>(std::nearbyint(4.0L * turns)) & 3;
        const long double c = std::cos(2.0L * M_PIl * r);
        const long double s = std::sin(2.0L * M_PIl * r);
        cosine.add(turns, point.x, quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s);
        sine.add(turns, point.y, quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c);
    });
    EXPECT_LE(cosine.ulps, 3.0) << cosine.at;
    EXPECT_LE(sine.ulps, 3.0) << sine.at;
}

TEST(SharedMath, circlePointIsExactAtTheQuadrants) {
    for (int quarter = -8; quarter <= 8; ++quarter) {
        const vec2 point = circlePoint(0.25f * static_cast<float>(quarter));
        const int quadrant = quarter & 3;
        EXPECT_EQ(point.x, quadrant == 0 ? 1.0f : quadrant == 2 ? -1.0f : 0.0f);
        EXPECT_EQ(point.y, quadrant == 1 ? 1.0f : quadrant == 3 ? -1.0f : 0.0f);
    }
}

TEST(SharedMath, circlePointForgetsWholeTurns) {
    const float last = 1048576.0f;
    for (const float part : {0.0f, 0.125f, 0.375f, 0.875f}) {
        EXPECT_EQ(circlePoint(last - 1.0f + part), circlePoint(part));
        EXPECT_EQ(circlePoint(-last + part), circlePoint(part));
    }
}

TEST(SharedMath, exponential) {
    WorstError worst;
    forDomain(kMinExponent, kMaxExponent,
              [&](float x) { worst.add(x, exponential(x), std::exp(static_cast<long double>(x))); });
    EXPECT_LE(worst.ulps, 2.0) << worst.at;
    EXPECT_EQ(exponential(0.0f), 1.0f);
    EXPECT_EQ(exponential(-88.0f), 0.0f);
    EXPECT_EQ(exponential(-1e30f), 0.0f);
    EXPECT_EQ(exponential(1e30f), exponential(kMaxExponent));
}

TEST(SharedMath, logarithm) {
    WorstError worst;
    const auto visit = [&](float x) {
        if (x >= std::numeric_limits<float>::min()) {
            worst.add(x, logarithm(x), std::log(static_cast<long double>(x)));
        }
    };
    forDomain(0.0f, 2.0f, visit);
    forDomain(0.0f, std::numeric_limits<float>::max(), visit);
    for (int step = -2000; step <= 2000; ++step) { // where the result nearly cancels
        visit(1.0f + static_cast<float>(step) * 0x1p-24f);
    }
    EXPECT_LE(worst.ulps, 2.0) << worst.at;
    EXPECT_EQ(logarithm(1.0f), 0.0f);
}

TEST(SharedMath, powerKeepsItsRelativeError) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> logBase(-40.0f, 40.0f);
    std::uniform_real_distribution<float> exponent(-200.0f, 200.0f);
    double worst = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        const float base = std::exp(logBase(random));
        const float e = exponent(random);
        const long double size = e * std::log(static_cast<long double>(base));
        if (size > kMinExponent && size < kMaxExponent - 0.001L) {
            const long double exact = std::exp(size);
            const long double error = std::abs(power(base, e) - exact) / exact;
            worst = std::max(worst, static_cast<double>(error / (0x1p-22L * (1.0L + std::abs(size)))));
        }
    }
    EXPECT_LE(worst, 1.0);
    EXPECT_EQ(power(0.25f, 0.0f), 1.0f);
}

TEST(SharedMath, arcTangent) {
    WorstError worst;
    forDomain(-1e6f, 1e6f, [&](float y) {
        for (const float x : {1.0f, -1.0f, 1e-3f, 1e5f}) {
            worst.add(y, arcTangent(y, x),
                      std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
        }
    });
    EXPECT_LE(worst.ulps, 3.0) << worst.at;
    EXPECT_EQ(arcTangent(0.0f, 0.0f), 0.0f);
    EXPECT_EQ(arcTangent(0.0f, -1.0f), kPi);
    EXPECT_EQ(arcTangent(-2.0f, 0.0f), -kHalfPi);
}

TEST(SharedMath, arcCosine) {
    WorstError worst;
    forDomain(-1.0f, 1.0f,
              [&](float x) { worst.add(x, arcCosine(x), std::acos(static_cast<long double>(x))); });
    EXPECT_LE(worst.ulps, 4.0) << worst.at;
    EXPECT_EQ(arcCosine(1.0f), 0.0f);
    EXPECT_EQ(arcCosine(-1.0f), kPi);
    EXPECT_EQ(arcCosine(1.5f), 0.0f);
}

TEST(SharedMath, basisIsOrthonormalAlsoAtThePole) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 100'000; ++i) {
        const float flat = i % 2 == 0 ? 1.0f : 1e-6f; // every other direction is next to a pole
        const vec3 n = unitVector(vec3(flat * normal(random), flat * normal(random), normal(random)));
        const Basis basis = basisAround(n);
        for (const vec3 axis : {basis.tangent, basis.bitangent}) {
            ASSERT_NEAR(dotProduct(axis, axis), 1.0f, 1e-6f);
            ASSERT_NEAR(dotProduct(axis, n), 0.0f, 1e-6f);
        }
        const vec3 up = crossProduct(basis.tangent, basis.bitangent);
        ASSERT_NEAR(dotProduct(up, n), 1.0f, 1e-6f);
    }
}

} // namespace
} // namespace metamarch
