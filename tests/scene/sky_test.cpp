// SPDX-License-Identifier: MIT
// The sky for scenes without light: plausible values, and no NaN.
#include "metamarch/shading/light/sky.h"
#include "metamarch/shading/surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

constexpr std::uint32_t kWidth = 64; // and as many rows

Sky skyAt(float elevation, float azimuth = 0.0f, float haze = 1.0f) {
    return makeSky({.sunElevation = elevation, .sunAzimuth = azimuth, .haze = haze, .resolution = kWidth});
}

Sky skyAtFullSize(float elevation) {
    SkySettings settings;
    settings.sunElevation = elevation;
    return makeSky(settings);
}

// Returns the irradiance of a surface that faces the sun.
glm::vec3 irradianceOf(const LightRecord& sun) {
    return sun.strength * static_cast<float>(M_PI * sun.scale * (2.0 - sun.scale));
}

// Returns the irradiance of level ground.
glm::dvec3 skyIrradiance(const Environment& map) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t y = 0; y < map.height / 2; ++y) {
        const double top = M_PI * y / map.height;
        const double bottom = M_PI * (y + 1.0) / map.height;
        const double weight = (std::pow(std::sin(bottom), 2.0) - std::pow(std::sin(top), 2.0)) * M_PI;
        for (std::uint32_t x = 0; x < map.width; ++x) {
            sum += glm::dvec3(map.texels[std::size_t{y} * map.width + x]) * (weight / map.width);
        }
    }
    return sum;
}

// The sky is symmetric around the sun, wherever that stands.
TEST(Sky, turnsWithTheSun) {
    const Environment still = skyAt(0.4f).environment;
    const Environment turned = skyAt(0.4f, static_cast<float>(2.0 * M_PI * 5.0 / kWidth)).environment;
    for (std::uint32_t y = 0; y < still.height; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const glm::vec3& before = still.texels[std::size_t{y} * kWidth + x];
            const glm::vec3& after = turned.texels[std::size_t{y} * kWidth + (x + 5) % kWidth];
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(after[c], before[c], 2e-6f * before[c]) << x << ' ' << y;
            }
        }
    }
}

TEST(Sky, isFiniteAndNotNegativeUnderEverySun) {
    for (const float elevation : {-1.5707963f, -0.3f, -0.01f, 0.0f, 1e-4f, 0.1f, 0.8f, 1.5707963f}) {
        for (const float haze : {0.0f, 1.0f, 20.0f}) {
            const Sky sky = skyAt(elevation, 2.0f, haze);
            ASSERT_EQ(sky.environment.width, kWidth);
            ASSERT_EQ(sky.environment.height, kWidth);
            ASSERT_EQ(sky.environment.texels.size(), kWidth * kWidth);
            for (const glm::vec3& texel : sky.environment.texels) {
                for (int channel = 0; channel < 3; ++channel) {
                    ASSERT_TRUE(texel[channel] >= 0.0f && std::isfinite(texel[channel]))
                        << elevation << " " << haze;
                }
            }
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_TRUE(sky.sun.strength[channel] >= 0.0f && std::isfinite(sky.sun.strength[channel]));
            }
        }
    }
}

TEST(Sky, hasTheSunWhereItWasAskedFor) {
    const LightRecord sun = skyAt(0.5f, 1.2f).sun;
    EXPECT_EQ(sun.kind, kLightDisc);
    EXPECT_NEAR(sun.direction.x, std::cos(0.5) * std::cos(1.2), 1e-6);
    EXPECT_NEAR(sun.direction.y, std::sin(0.5), 1e-6);
    EXPECT_NEAR(sun.direction.z, std::cos(0.5) * std::sin(1.2), 1e-6);
    // The sun's diameter is 0.533 degrees.
    EXPECT_NEAR(std::acos(1.0 - double{sun.scale}) * 180.0 / M_PI, 0.2665, 1e-4);
}

// By ASTM G173, the sun at an elevation of 42 degrees gives 900 of 1348 W/m^2, and a clear sky about a tenth.
TEST(Sky, passesMostSunlightAtNoon) {
    const Sky sky = skyAt(static_cast<float>(M_PI / 2.0));
    const glm::vec3 sun = irradianceOf(sky.sun) / static_cast<float>(M_PI);
    EXPECT_LT(sun.r, 1.0f);
    EXPECT_GT(sun.b, 0.5f);
    EXPECT_GT(sun.r, sun.g);
    EXPECT_GT(sun.g, sun.b);
    const glm::dvec3 scattered = skyIrradiance(sky.environment) / M_PI;
    EXPECT_GT(scattered.g, 0.03);
    EXPECT_LT(scattered.g, 0.3);
    EXPECT_LT(sun.g + scattered.g, 1.0); // not more than the incident light
}

// The haze at the horizon may be brighter than the sky near the sun, so only the sky above it is searched.
TEST(Sky, isBlueAboveAndBrightestTowardsTheSun) {
    const float azimuth = 0.7f;
    const Environment map = skyAt(0.6f, azimuth).environment;
    const glm::vec3 zenith = map.texels[kWidth / 2];
    EXPECT_GT(zenith.b, 1.5f * zenith.r);
    const auto brightest = std::max_element(map.texels.begin(), map.texels.begin() + kWidth * kWidth * 2 / 5,
                                            [](const glm::vec3& a, const glm::vec3& b) { return a.g < b.g; });
    const auto index = static_cast<std::size_t>(brightest - map.texels.begin());
    const std::size_t column = index % kWidth;
    const std::size_t row = index / kWidth;
    const double texel = 2.0 * M_PI / kWidth; // width in radians; the height is half of that
    const double foundAzimuth = (static_cast<double>(column) + 0.5) * texel - M_PI;
    const double foundElevation = M_PI / 2.0 - (static_cast<double>(row) + 0.5) * texel / 2.0;
    EXPECT_NEAR(foundAzimuth, azimuth, texel);
    EXPECT_NEAR(foundElevation, 0.6, 2.0 * texel);
}

TEST(Sky, reddensAndDimsTheSinkingSun) {
    glm::vec3 last(1e9f);
    for (const float elevation : {1.2f, 0.8f, 0.4f, 0.2f, 0.1f, 0.03f, 0.0f}) {
        const glm::vec3 sun = irradianceOf(skyAt(elevation).sun);
        EXPECT_LT(sun.r, last.r);
        EXPECT_LT(sun.b / sun.r, last.b / last.r);
        last = sun;
    }
}

TEST(Sky, hasNoSunBelowTheHorizonAndDarkensAfterIt) {
    const Sky set = skyAt(-0.05f);
    EXPECT_EQ(set.sun.strength, glm::vec3(0.0f));
    EXPECT_GT(skyIrradiance(set.environment).g, 0.0);
    EXPECT_LT(skyIrradiance(set.environment).g, 0.1 * skyIrradiance(skyAt(0.05f).environment).g);
    EXPECT_LT(skyIrradiance(skyAt(-1.0f).environment).g, 1e-6);
}

// Returns the optical depth of the air from a point towards a direction, or infinity if the ground is in the
// way. Lengths are in kilometres; the coefficients are Hillaire's.
glm::dvec3 depthAlong(const glm::dvec3& point, const glm::dvec3& direction, const double reach) {
    constexpr int kSteps = 200;
    glm::dvec3 depth(0.0);
    for (int i = 0; i < kSteps; ++i) {
        const double height = glm::length(point + direction * (reach * (i + 0.5) / kSteps)) - 6360.0;
        if (height < 0.0) {
            return glm::dvec3(INFINITY);
        }
        const double ozone = std::max(1.0 - std::abs(height - 25.0) / 15.0, 0.0);
        depth += (glm::dvec3(5.802e-3, 13.558e-3, 33.1e-3) * std::exp(-height / 8.0) +
                  glm::dvec3(8.396e-3 * std::exp(-height / 1.2)) +
                  glm::dvec3(0.650e-3, 1.881e-3, 0.085e-3) * ozone) *
                 (reach / kSteps);
    }
    return depth;
}

double distanceToSpace(const glm::dvec3& point, const glm::dvec3& direction) {
    const double b = glm::dot(point, direction);
    return -b + std::sqrt(b * b - glm::dot(point, point) + 6460.0 * 6460.0);
}

// Returns the light scattered once along one line of sight, by plain sums.
glm::dvec3 scatteredAlong(const glm::dvec3& direction, const glm::dvec3& sun) {
    constexpr int kSteps = 500;
    constexpr double g = 0.8;
    const double cosine = glm::dot(direction, sun);
    const double rayleighPhase = 3.0 / (16.0 * M_PI) * (1.0 + cosine * cosine);
    const double miePhase = 3.0 / (8.0 * M_PI) * (1.0 - g * g) * (1.0 + cosine * cosine) /
                            ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
    const glm::dvec3 eye(0.0, 6360.002, 0.0);
    const double reach = distanceToSpace(eye, direction);
    glm::dvec3 sum(0.0);
    double start = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
        const double end = reach * i / kSteps * i / kSteps;
        const double middle = 0.5 * (start + end);
        const glm::dvec3 here = eye + direction * middle;
        const double height = glm::length(here) - 6360.0;
        const glm::dvec3 depth =
            depthAlong(eye, direction, middle) + depthAlong(here, sun, distanceToSpace(here, sun));
        sum += (glm::dvec3(5.802e-3, 13.558e-3, 33.1e-3) * (std::exp(-height / 8.0) * rayleighPhase) +
                glm::dvec3(3.996e-3 * std::exp(-height / 1.2) * miePhase)) *
               glm::exp(-depth) * (M_PI * (end - start));
        start = end;
    }
    return sum;
}

// The steps of makeSky, which are fewer, make a difference of up to 0.4 %.
TEST(Sky, isTheLightScatteredAlongEachLineOfSight) {
    for (const float elevation : {0.785398163f, 0.2f}) {
        const Sky sky = skyAt(elevation, 0.03f);
        for (std::uint32_t y = 1; y < kWidth / 2; y += 6) {
            for (std::uint32_t x = 0; x < kWidth; x += 7) {
                const double polar = M_PI * (y + 0.5) / kWidth;
                const double azimuth = 2.0 * M_PI * ((x + 0.5) / kWidth - 0.5);
                const glm::dvec3 direction(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                           std::sin(polar) * std::sin(azimuth));
                const glm::dvec3 expected = scatteredAlong(direction, glm::dvec3(sky.sun.direction));
                const glm::vec3& texel = sky.environment.texels[std::size_t{y} * kWidth + x];
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(texel[c], expected[c], 5e-3 * expected[c])
                        << elevation << ' ' << x << ' ' << y;
                }
            }
        }
    }
}

// The process keeps the last sky.
TEST(Sky, isThatOfItsSunEachTime) {
    const auto surroundingsOf = [](const float elevation, const float azimuth, const float intensity) {
        LightChoice light;
        light.kind = LightChoice::Kind::sky;
        light.intensity = intensity;
        light.sunElevation = elevation;
        light.sunAzimuth = azimuth;
        return makeSurroundings({}, "scene", light);
    };
    const Surroundings first = surroundingsOf(0.5f, 0.0f, 1.0f);
    EXPECT_EQ(first.environment->texels, skyAtFullSize(0.5f).environment.texels);
    const Surroundings brighter = surroundingsOf(0.5f, 0.0f, 4.0f);
    EXPECT_EQ(brighter.environment->texels, first.environment->texels);
    EXPECT_EQ(brighter.sun->strength, 4.0f * first.sun->strength);
    EXPECT_EQ(surroundingsOf(0.5f, 0.0f, 1.0f).sun->strength, first.sun->strength);
    EXPECT_NE(surroundingsOf(0.5f, 1.0f, 1.0f).environment->texels, first.environment->texels);
    EXPECT_NE(surroundingsOf(0.6f, 0.0f, 1.0f).environment->texels, first.environment->texels);
}

TEST(Sky, lightsItsGroundAsALambertian) {
    const SkySettings settings = {
        .sunElevation = 0.6f, .groundAlbedo = glm::vec3(0.2f, 0.4f, 0.8f), .resolution = 256};
    const Sky sky = makeSky(settings);
    const glm::dvec3 irradiance =
        skyIrradiance(sky.environment) + glm::dvec3(irradianceOf(sky.sun)) * double{sky.sun.direction.y};
    const glm::vec3 ground = sky.environment.texels.back();
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(ground[channel], settings.groundAlbedo[channel] * irradiance[channel] / M_PI,
                    2e-3 * ground[channel]);
    }
    EXPECT_EQ(sky.environment.texels[std::size_t{256} * 128], ground);
}

} // namespace
} // namespace metamarch
