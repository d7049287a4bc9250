// SPDX-License-Identifier: MIT
// The map's directions, and the sampling of its texels.
#include "chi_square.h"
#include "metamarch/shading/light/weighted_table.h"
#include "metamarch/shared/scene_light.h"
#include "metamarch/shared/sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace metamarch {
namespace {

constexpr int kDraws = 60'000;
constexpr int kTests = 4; // number of chi-square tests in this file

TEST(EnvironmentMap, hasItsAxesWhereItSays) {
    const auto expectAt = [](vec3 direction, float u, float v) {
        const vec2 point = mapPoint(direction);
        EXPECT_NEAR(point.x, u, 1e-7f);
        EXPECT_NEAR(point.y, v, 1e-7f);
        const vec3 back = mapDirection(vec2(u, v));
        EXPECT_NEAR(glm::length(back - direction), 0.0f, 1e-6f);
    };
    expectAt(vec3(1, 0, 0), 0.5f, 0.5f);
    expectAt(vec3(0, 0, 1), 0.75f, 0.5f);
    expectAt(vec3(0, 0, -1), 0.25f, 0.5f);
    expectAt(vec3(-1, 0, 0), 1.0f, 0.5f);
    EXPECT_EQ(mapPoint(vec3(0, 1, 0)).y, 0.0f);
    EXPECT_EQ(mapPoint(vec3(0, -1, 0)).y, 1.0f);
}

// Over the whole map, and within a texel of the poles for 8192 x 4096 texels.
TEST(EnvironmentMap, directionAndPointAreInverse) {
    std::mt19937 random(31);
    std::uniform_real_distribution<float> even(0.0f, 1.0f);
    for (int i = 0; i < 100'000; ++i) {
        const float nearPole = std::exp(-12.0f * even(random));
        const float v = i % 3 == 0 ? even(random) : i % 3 == 1 ? 0.5f * nearPole : 1.0f - 0.5f * nearPole;
        const vec2 point(even(random), v);
        const vec3 direction = mapDirection(point);
        ASSERT_NEAR(dotProduct(direction, direction), 1.0f, 1e-6f);
        const vec2 found = mapPoint(direction);
        ASSERT_TRUE(found.x >= 0.0f && found.x <= 1.0f && found.y >= 0.0f && found.y <= 1.0f);
        ASSERT_NEAR(found.x - point.x, std::round(found.x - point.x), 3e-7f) << point.x << "," << point.y;
        ASSERT_NEAR(found.y, point.y, 3e-7f) << point.x << "," << point.y;
    }
    for (const float x : {-1.0f, -0.0f, 0.0f, 1.0f}) {
        for (const float z : {-1e-30f, -0.0f, 0.0f, 1e-30f}) {
            const vec2 point = mapPoint(vec3(x, std::sqrt(1.0f - x * x), z));
            EXPECT_TRUE(point.x >= 0.0f && point.x <= 1.0f && point.y >= 0.0f && point.y <= 1.0f);
        }
    }
}

Environment flat(uint width, uint height, vec3 radiance) {
    Environment map;
    map.width = width;
    map.height = height;
    map.texels.assign(std::size_t{width} * height, radiance);
    return map;
}

// Returns a dim map with one texel that outshines all others together.
Environment brightTexel() {
    Environment map = flat(8, 4, vec3(0.1f, 0.2f, 0.3f));
    map.texels[2 * 8 + 5] = glm::vec3(50.0f);
    map.texels[0] = glm::vec3(0.0f);
    return map;
}

// A scene with no other light than a map.
class DrawnMap {
  public:
    explicit DrawnMap(const Environment& map) {
        const EnvironmentTables tables = makeEnvironmentTables(map);
        for (std::size_t i = 0; i < map.texels.size(); ++i) {
            scene_.environment.emplace_back(map.texels[i], tables.weights[i]);
        }
        scene_.tables = tables.blocks;
        scene_.tables.insert(scene_.tables.end(), tables.rows.begin(), tables.rows.end());
        scene_.tables.insert(scene_.tables.end(), tables.columns.begin(), tables.columns.end());
        scene_.features = kFeatureEnvironment | kFeatureLights;
        scene_.settings.blockColumnShift = tables.blockColumnShift;
        scene_.settings.blockRowShift = tables.blockRowShift;
        scene_.settings.environmentWidth = map.width;
        scene_.settings.environmentHeight = map.height;
        scene_.settings.environmentProbability = 1.0f;
        scene_.settings.environmentCosine = 1.0f;
        scene_.settings.environmentScale = 1.0f;
    }

    LightSample draw(vec2 u, uint bin = kAnyNormal) const {
        return sampleEnvironment(scene_, scene_.settings, bin, u);
    }

    EnvironmentLight lightFrom(vec3 direction, uint bin = kAnyNormal) const {
        return environmentLight(scene_, scene_.settings, direction, bin);
    }

  private:
    ShadingScene scene_;
};

// Also where a normal sees a part of the map, and where blocks have one cell or many.
TEST(EnvironmentMap, isDrawnByItsDensity) {
    const auto expectDrawn = [](const Environment& map, const uint bin) {
        const DrawnMap drawn(map);
        std::mt19937 random(32);
        const auto draw = [&] {
            const float first = unitInterval(static_cast<uint>(random()));
            const vec2 u(first, unitInterval(static_cast<uint>(random())));
            return DrawnDirection{true, drawn.draw(u, bin).wi};
        };
        const auto density = [&](vec3 direction) {
            return static_cast<double>(drawn.lightFrom(direction, bin).pdf);
        };
        EXPECT_GT(chiSquareProbability(sphereHistogram(kDraws, draw, density)), significanceOf(kTests))
            << map.width << " " << bin;
    };
    expectDrawn(brightTexel(), kAnyNormal);
    expectDrawn(brightTexel(), normalBin(vec3(0, 1, 0)));
    expectDrawn(flat(1, 1, vec3(1.0f)), kAnyNormal);
    expectDrawn(flat(50, 30, vec3(1.0f)), normalBin(unitVector(vec3(1, -2, 3))));
}

// Each normal is in a bin of its own face, within the bin's angles.
TEST(EnvironmentMap, everyNormalHasABin) {
    std::mt19937 random(33);
    std::normal_distribution<float> normal;
    std::vector<vec3> means(kNormalBins, vec3(0.0f));
    std::vector<vec3> normals;
    for (int i = 0; i < 100'000; ++i) {
        normals.push_back(unitVector(vec3(normal(random), normal(random), normal(random))));
        const uint bin = normalBin(normals.back());
        ASSERT_LT(bin, kNormalBins);
        means[bin] += normals.back();
    }
    for (const vec3 n : normals) {
        // The diagonal of the middle bins is the longest: 2 atan(sqrt(2) / 3) / 2.
        ASSERT_GT(dotProduct(n, unitVector(means[normalBin(n)])), std::cos(0.45f));
    }
    for (const float x : {-1.0f, -0.0f, 0.0f, 1.0f}) {
        for (const float y : {-1.0f, -0.0f, 0.0f, 1.0f}) {
            EXPECT_LT(normalBin(unitVector(vec3(x, y, 1.0f))), kNormalBins);
            EXPECT_LT(normalBin(unitVector(vec3(x, -1.0f, y))), kNormalBins);
        }
    }
}

// A surface that sees none of the map's light draws too, and never a block outside the map.
TEST(EnvironmentMap, isDrawnWhereItIsDark) {
    Environment sun = flat(600, 300, vec3(0.0f));
    sun.texels[50 * 600 + 100] = vec3(1000.0f);
    for (const Environment& map : {flat(1, 1, vec3(1.0f)), brightTexel(), sun}) {
        const DrawnMap drawn(map);
        for (uint bin = 0; bin <= kAnyNormal; ++bin) {
            for (uint i = 0; i < 16; ++i) {
                const LightSample sample = drawn.draw(sample2d(makePixelSample(0, 0, i, 4), 0), bin);
                ASSERT_GT(sample.pdf, 0.0f) << map.width << " " << bin;
                ASSERT_NEAR(drawn.lightFrom(sample.wi, bin).pdf, sample.pdf, 1e-3f * sample.pdf)
                    << map.width << " " << bin;
            }
        }
    }
}

// Half of a uniform map lies below the horizon of each surface; few samples go there.
TEST(EnvironmentMap, isDrawnAboveTheSurface) {
    const DrawnMap drawn(flat(256, 128, vec3(1.0f)));
    for (const vec3 normal : {vec3(0, 1, 0), vec3(1, 0, 0), unitVector(vec3(-1, -1, 0.5f))}) {
        int above = 0;
        double sum = 0.0;
        constexpr uint kSamples = 4096;
        for (uint i = 0; i < kSamples; ++i) {
            const vec2 u = sample2d(makePixelSample(0, 0, i, 3), 0);
            const LightSample sample = drawn.draw(u, normalBin(normal));
            const float cosine = dotProduct(sample.wi, normal);
            above += cosine > 0.0f ? 1 : 0;
            sum += std::max(cosine, 0.0f) * sample.arriving.x / kSamples;
        }
        EXPECT_GT(above, 0.9 * kSamples);
        EXPECT_NEAR(sum, M_PI, 0.02 * M_PI); // the irradiance
    }
}

TEST(EnvironmentMap, densityIntegratesToOne) {
    const DrawnMap drawn(brightTexel());
    const uint bin = normalBin(unitVector(vec3(1, 2, -1)));
    constexpr int kRows = 1024;
    constexpr int kColumns = 512;
    double sum = 0.0;
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const double polar = M_PI * (row + 0.5) / kRows;
            const double azimuth = 2.0 * M_PI * (column + 0.5) / kColumns;
            const vec3 direction(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                 std::sin(polar) * std::sin(azimuth));
            sum += drawn.lightFrom(direction, bin).pdf * std::sin(polar) * (M_PI / kRows) *
                   (2.0 * M_PI / kColumns);
        }
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
}

// A sample's pdf is the pdf of its direction, and both see the same light.
TEST(EnvironmentMap, samplesKnowTheirDensity) {
    for (const Environment& map : {brightTexel(), flat(1, 1, vec3(1.0f)), flat(3, 1, vec3(2.0f))}) {
        const DrawnMap drawn(map);
        for (uint i = 0; i < 20'000; ++i) {
            const LightSample sample =
                drawn.draw(sample2d(makePixelSample(0, 0, i, 1), bounceDimension(0, kBounceLight)));
            const EnvironmentLight found = drawn.lightFrom(sample.wi);
            ASSERT_GT(sample.pdf, 0.0f);
            // Near the poles and beside the bright texel the density changes most within a rounding error.
            ASSERT_NEAR(found.pdf, sample.pdf, 1e-3f * sample.pdf) << i;
            ASSERT_NEAR(found.radiance.x, sample.arriving.x * sample.pdf, 1e-3f * found.radiance.x) << i;
        }
    }
}

// The density follows the light less half of the map's mean. The weight contains the sine at the centres of
// texels, so where only one row of them is bright, the two differ by at most the sine's change over a row.
TEST(EnvironmentMap, densityFollowsTheFilteredLight) {
    Environment map = flat(128, 64, vec3(0.5f));
    map.texels[20 * 128 + 9] = glm::vec3(1000.0f);
    map.texels[20 * 128 + 10] = glm::vec3(300.0f);
    const DrawnMap drawn(map);
    double light = 0.0;
    double sines = 0.0;
    for (std::size_t i = 0; i < map.texels.size(); ++i) {
        const std::size_t row = i / 128;
        const double sine = std::sin(M_PI * (static_cast<double>(row) + 0.5) / 64.0);
        light += map.texels[i].x * sine;
        sines += sine;
    }
    const double left = 0.5 * light / sines;
    const double whole = (light - left * sines) * 2.0 * M_PI / 128.0 * M_PI / 64.0;
    for (uint i = 0; i < 4096; ++i) {
        const LightSample sample = drawn.draw(sample2d(makePixelSample(0, 0, i, 2), 0));
        if (std::abs(sample.wi.y) < 0.9f) {
            const double radiance = static_cast<double>(sample.arriving.x) * sample.pdf;
            const double change = M_PI / 64.0 * std::abs(sample.wi.y) / mapSine(sample.wi);
            ASSERT_NEAR(radiance - left, whole * sample.pdf, (change + 0.001) * radiance) << i;
        }
    }
}

} // namespace
} // namespace metamarch
