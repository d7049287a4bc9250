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
constexpr int kTests = 2; // number of chi-square tests in this file

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

class DrawnMap {
  public:
    explicit DrawnMap(const Environment& map)
        : width_(map.width), height_(map.height), tables_(makeEnvironmentTables(map)) {
        scene_.tables = tables_.rows;
        scene_.tables.insert(scene_.tables.end(), tables_.columns.begin(), tables_.columns.end());
    }

    struct Drawn {
        vec3 direction;
        double density;
    };

    Drawn draw(vec2 u) const {
        const TableChoice row = chooseFromTable(scene_, 0, height_, u.y);
        const TableChoice column = chooseFromTable(scene_, height_ + row.index * width_, width_, u.x);
        const vec3 direction = mapDirection(mapPointIn(row, column, width_, height_));
        return {direction, densityIn(column.index, row.index, direction)};
    }

    double densityAt(vec3 direction) const {
        const vec2 point = mapPoint(direction);
        const uint x = std::min(static_cast<uint>(point.x * static_cast<float>(width_)), width_ - 1);
        const uint y = std::min(static_cast<uint>(point.y * static_cast<float>(height_)), height_ - 1);
        return densityIn(x, y, direction);
    }

  private:
    double densityIn(uint x, uint y, vec3 direction) const {
        return mapDensity(tables_.rows[y].probability, tables_.columns[y * width_ + x].probability, width_,
                          height_, mapSine(direction));
    }

    uint width_;
    uint height_;
    EnvironmentTables tables_;
    ShadingScene scene_;
};

TEST(EnvironmentMap, isDrawnByItsDensity) {
    for (const Environment& map : {brightTexel(), flat(1, 1, vec3(1.0f))}) {
        const DrawnMap drawn(map);
        std::mt19937 random(32);
        const auto draw = [&] {
            const float first = unitInterval(static_cast<uint>(random()));
            return DrawnDirection{
                true, drawn.draw(vec2(first, unitInterval(static_cast<uint>(random())))).direction};
        };
        const auto density = [&](vec3 direction) { return drawn.densityAt(direction); };
        EXPECT_GT(chiSquareProbability(sphereHistogram(kDraws, draw, density)), significanceOf(kTests))
            << map.width;
    }
}

TEST(EnvironmentMap, densityIntegratesToOne) {
    const DrawnMap drawn(brightTexel());
    constexpr int kRows = 1024;
    constexpr int kColumns = 512;
    double sum = 0.0;
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const double polar = M_PI * (row + 0.5) / kRows;
            const double azimuth = 2.0 * M_PI * (column + 0.5) / kColumns;
            const vec3 direction(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                 std::sin(polar) * std::sin(azimuth));
            sum += drawn.densityAt(direction) * std::sin(polar) * (M_PI / kRows) * (2.0 * M_PI / kColumns);
        }
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
}

// A sample's pdf is the pdf of its direction, except where rounding moves it across a texel's border.
TEST(EnvironmentMap, samplesKnowTheirDensity) {
    const DrawnMap drawn(brightTexel());
    int different = 0;
    for (uint i = 0; i < 20'000; ++i) {
        const DrawnMap::Drawn sample =
            drawn.draw(sample2d(makePixelSample(0, 0, i, 1), bounceDimension(0, kBounceLight)));
        ASSERT_GT(sample.density, 0.0);
        different += std::abs(drawn.densityAt(sample.direction) / sample.density - 1.0) > 1e-5 ? 1 : 0;
    }
    EXPECT_LE(different, 2);
}

} // namespace
} // namespace metamarch
