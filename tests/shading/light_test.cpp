// SPDX-License-Identifier: MIT
// Light sampling against closed forms, and its samples against their densities.
#include "chi_square.h"
#include "metamarch/shared/light.h"
#include "metamarch/shared/sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace metamarch {
namespace {

constexpr int kDraws = 200'000;
constexpr int kTests = 2; // number of chi-square tests in this file

float drawFrom(std::mt19937& random) { return unitInterval(static_cast<uint>(random())); }

TEST(PowerHeuristic, weightsOfBothWaysSumToOne) {
    for (double own = 1e-20; own < 1e21; own *= 3.7) {
        for (double other = 1e-20; other < 1e21; other *= 5.3) {
            const auto a = static_cast<float>(own);
            const auto b = static_cast<float>(other);
            ASSERT_NEAR(powerHeuristic(a, b) + powerHeuristic(b, a), 1.0f, 2e-7f) << own << " " << other;
            ASSERT_NEAR(balanceHeuristic(a, b) + balanceHeuristic(b, a), 1.0f, 2e-7f) << own << " " << other;
        }
    }
    EXPECT_EQ(powerHeuristic(2.0f, 0.0f), 1.0f); // no other technique finds it
    EXPECT_LT(powerHeuristic(0.0f, 2.0f), 1e-30f);
    EXPECT_NEAR(powerHeuristic(3.0f, 1.0f), 0.9f, 1e-7f);
    EXPECT_EQ(balanceHeuristic(3.0f, 1.0f), 0.75f);
    EXPECT_EQ(balanceHeuristic(2.0f, 0.0f), 1.0f);
}

TEST(TableChoice, leavesANumberAsGoodAsNew) {
    constexpr TableEntry kEntry{0.25f, 0.625f, 0.375f, 0u};
    for (uint i = 1u << 22; i < 5u << 21; ++i) {
        const TableChoice choice = chosenEntry(kEntry, 7u, unitInterval(i << 8u));
        ASSERT_EQ(choice.index, 7u);
        ASSERT_EQ(choice.probability, 0.375f);
        ASSERT_NEAR(choice.uRemapped, (i - (1u << 22)) / static_cast<double>((5u << 21) - (1u << 22)), 1e-7);
        ASSERT_LT(choice.uRemapped, 1.0f);
    }
}

TEST(GuideSlot, staysInsideItsTable) {
    for (const uint slots : {1u, 3u, 1000u, 65'536u}) {
        EXPECT_EQ(guideSlot(0.0f, slots), 0u);
        EXPECT_EQ(guideSlot(unitInterval(0xffffffffu), slots), slots - 1u);
    }
}

TEST(TriangleSample, isUniformInArea) {
    // Cells of equal area: strips of equal area, counted from the third corner, divided uniformly.
    constexpr std::size_t kStrips = 12;
    constexpr std::size_t kParts = 12;
    std::mt19937 random(21);
    Histogram histogram = evenHistogram(kStrips * kParts, kDraws);
    for (int i = 0; i < kDraws; ++i) {
        const float first = drawFrom(random);
        const vec3 corners = sampleTriangle(vec2(first, drawFrom(random)));
        ASSERT_GE(smallest(corners), 0.0f);
        ASSERT_NEAR(corners.x + corners.y + corners.z, 1.0f, 1e-6f);
        // The place is counted from the third corner; its square is the fraction of the area up to there.
        const double away = 1.0 - corners.z;
        const std::size_t strip = partOf(away * away, kStrips);
        const std::size_t part = away > 0.0 ? partOf(corners.x / away, kParts) : 0;
        histogram.observed[strip * kParts + part] += 1.0;
    }
    EXPECT_GT(chiSquareProbability(histogram), significanceOf(kTests));
}

TEST(SolidAngleDensity, isThatOfASmallPatch) {
    // A patch with an area of 0.01, seen at 60 degrees from distance 2, covers 0.01 * cos 60 / 4 steradians.
    EXPECT_NEAR(solidAngleDensity(1.0f / 0.01f, 4.0f, 0.5f), 4.0f / (0.01f * 0.5f), 1e-2f);
    EXPECT_EQ(solidAngleDensity(100.0f, 4.0f, -0.5f), solidAngleDensity(100.0f, 4.0f, 0.5f));
    EXPECT_EQ(solidAngleDensity(100.0f, 4.0f, 0.0f), 0.0f);
}

TEST(PointLight, fallsWithTheSquareOfTheDistance) {
    LightRecord light{};
    light.kind = kLightPoint;
    light.position = vec3(1, 2, 3);
    light.strength = vec3(8, 4, 2); // W/sr
    const LightSample drawn = sampleLight(light, vec3(1, 2, 5), vec2(0.3f, 0.7f));
    EXPECT_EQ(drawn.wi, vec3(0, 0, -1));
    EXPECT_EQ(drawn.distance, 2.0f);
    EXPECT_EQ(drawn.arriving, vec3(2, 1, 0.5f));
    EXPECT_EQ(drawn.pdf, 0.0f);
    // At the light's own position there is no direction, but the sample must be finite.
    const LightSample inside = sampleLight(light, light.position, vec2(0.3f, 0.7f));
    EXPECT_TRUE(std::isfinite(inside.arriving.x) && std::isfinite(inside.wi.x));
}

// KHR_lights_punctual: full intensity inside the inner cone, none outside the outer cone, and between them
// the square of a linear ramp in the cosine.
TEST(SpotLight, fallsBetweenItsCones) {
    constexpr double kInner = 0.3;
    constexpr double kOuter = 0.7;
    const vec2 falloff =
        makeSpotFalloff(static_cast<float>(std::cos(kInner)), static_cast<float>(std::cos(kOuter)));
    LightRecord light{};
    light.kind = kLightSpot;
    light.direction = vec3(0, 0, -1);
    light.strength = vec3(1.0f);
    light.scale = falloff.x;
    light.offset = falloff.y;
    for (double angle = 0.0; angle < 3.1; angle += 0.01) {
        const vec3 point(3.0 * std::sin(angle), 0.0, -3.0 * std::cos(angle));
        const double ramp = std::clamp(
            (std::cos(angle) - std::cos(kOuter)) / (std::cos(kInner) - std::cos(kOuter)), 0.0, 1.0);
        ASSERT_NEAR(sampleLight(light, point, vec2(0.5f)).arriving.x, ramp * ramp / 9.0, 1e-6) << angle;
    }
    // Equal cones make a sharp edge, within 0.001 of the cosine.
    const vec2 sharp = makeSpotFalloff(0.5f, 0.5f);
    EXPECT_TRUE(std::isfinite(sharp.x) && std::isfinite(sharp.y));
}

TEST(DirectionalLight, arrivesAlikeEverywhere) {
    LightRecord light{};
    light.kind = kLightDirectional;
    light.direction = unitVector(vec3(1, 2, 3));
    light.strength = vec3(5, 6, 7); // W/m^2
    for (const vec3 point : {vec3(0.0f), vec3(1e6f, 0, -1e6f)}) {
        const LightSample drawn = sampleLight(light, point, vec2(0.2f, 0.9f));
        EXPECT_EQ(drawn.wi, light.direction);
        EXPECT_EQ(drawn.distance, kFarLight);
        EXPECT_EQ(drawn.arriving, light.strength);
        EXPECT_EQ(drawn.pdf, 0.0f);
    }
    EXPECT_FALSE(hitsDisc(light, light.direction));
}

LightRecord disc(double angle, vec3 direction) {
    LightRecord light{};
    light.kind = kLightDisc;
    light.direction = unitVector(direction);
    light.scale = static_cast<float>(2.0 * std::pow(std::sin(angle / 2.0), 2.0));
    light.strength = vec3(3, 2, 1); // W/(m^2 sr)
    return light;
}

// A disc in the zenith with radiance L and angular radius a gives level ground the irradiance pi * L *
// sin(a)^2.
TEST(DiscLight, givesTheIrradianceOfItsCap) {
    for (const double angle : {0.0001, 0.00465, 0.1, 1.0, 1.5}) {
        const LightRecord light = disc(angle, vec3(0, 1, 0));
        double sum = 0.0;
        constexpr uint kSamples = 1u << 14;
        for (uint i = 0; i < kSamples; ++i) {
            const LightSample drawn =
                sampleLight(light, vec3(0.0f), sample2d(makePixelSample(0, 0, i, 1), kDimensionLens));
            ASSERT_NEAR(dotProduct(drawn.wi, drawn.wi), 1.0f, 1e-6f);
            ASSERT_EQ(drawn.distance, kFarLight);
            ASSERT_NEAR(drawn.arriving.x * drawn.pdf, light.strength.x, 1e-5f);
            sum += drawn.arriving.y * drawn.wi.y / kSamples;
        }
        const double expected = M_PI * light.strength.y * std::pow(std::sin(angle), 2.0);
        EXPECT_NEAR(sum, expected, 2e-4 * expected) << angle;
    }
}

TEST(DiscLight, isHitByTheDirectionsItDraws) {
    for (const double angle : {0.00465, 0.3}) {
        const LightRecord light = disc(angle, vec3(3, 1, -2));
        const Basis around = basisAround(light.direction);
        std::mt19937 random(22);
        int missed = 0;
        for (int i = 0; i < kDraws; ++i) {
            const float first = drawFrom(random);
            missed +=
                hitsDisc(light, sampleLight(light, vec3(0.0f), vec2(first, drawFrom(random))).wi) ? 0 : 1;
        }
        EXPECT_LE(missed, kDraws / 10'000); // samples on the rim that rounding moves out
        const auto at = [&](double off) {
            return unitVector(light.direction + around.tangent * static_cast<float>(std::tan(off)));
        };
        EXPECT_TRUE(hitsDisc(light, at(0.999 * angle)));
        EXPECT_FALSE(hitsDisc(light, at(1.001 * angle)));
        EXPECT_FALSE(hitsDisc(light, -light.direction));
    }
}

TEST(DiscLight, isDrawnEvenly) {
    constexpr std::size_t kRings = 10;
    constexpr std::size_t kSectors = 16;
    const LightRecord light = disc(0.8, vec3(0.3f, 0.2f, 1.0f));
    const Basis around = basisAround(light.direction);
    std::mt19937 random(23);
    Histogram histogram = evenHistogram(kRings * kSectors, kDraws);
    for (int i = 0; i < kDraws; ++i) {
        const float first = drawFrom(random);
        const vec3 wi = sampleLight(light, vec3(0.0f), vec2(first, drawFrom(random))).wi;
        const double outwards =
            (1.0 - dotProduct(wi, light.direction)) / light.scale; // fraction of the cap's area inside
        const double turn =
            std::atan2(dotProduct(wi, around.bitangent), dotProduct(wi, around.tangent)) / (2.0 * M_PI) + 0.5;
        const std::size_t ring = partOf(outwards, kRings);
        const std::size_t sector = partOf(turn, kSectors);
        histogram.observed[ring * kSectors + sector] += 1.0;
    }
    EXPECT_GT(chiSquareProbability(histogram), significanceOf(kTests));
}

} // namespace
} // namespace metamarch
