// SPDX-License-Identifier: MIT
// Light sampling, BSDF sampling and both have the same mean, with and without Russian roulette. Each is
// rendered with several seeds. Their means are independent, so their spread gives the standard error.
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace metamarch::tests {
namespace {

constexpr std::uint32_t kSeeds = 12;
// Both means of a difference have kSeeds - 1 degrees of freedom. More than 4.5 standard errors happen once in
// 5,000 times.
constexpr double kLargestZ = 4.5;

// The mean of each channel over each quarter of the picture, and its standard error.
struct Means {
    static constexpr std::size_t kCount = 12;
    std::array<double, kCount> mean{};
    std::array<double, kCount> error{};
};

std::array<double, Means::kCount> quartersOf(const std::vector<FilmPixel>& film, const std::uint32_t side) {
    std::array<double, Means::kCount> sums{};
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const glm::dvec3 mean = meanOf(film[std::size_t{y} * side + x]);
            const std::size_t quarter =
                std::size_t{3} * ((y < side / 2 ? 0u : 2u) + (x < side / 2 ? 0u : 1u));
            for (std::size_t c = 0; c < 3; ++c) {
                sums[quarter + c] += mean[static_cast<int>(c)] * 4.0 / (side * side);
            }
        }
    }
    return sums;
}

Means meansOf(const PathScene& made, PathWork work, const std::uint32_t firstSeed) {
    std::vector<std::array<double, Means::kCount>> runs;
    for (std::uint32_t i = 0; i < kSeeds; ++i) {
        work.seed = firstSeed + i;
        const auto film = render(made, work);
        EXPECT_EQ(rejectedOf(film), 0u);
        runs.push_back(quartersOf(film, work.side));
    }
    Means means;
    for (std::size_t k = 0; k < Means::kCount; ++k) {
        for (const auto& run : runs) {
            means.mean[k] += run[k] / kSeeds;
        }
        double squares = 0.0;
        for (const auto& run : runs) {
            squares += (run[k] - means.mean[k]) * (run[k] - means.mean[k]);
        }
        means.error[k] = std::sqrt(squares / (kSeeds - 1) / kSeeds);
    }
    return means;
}

// The error must be at most the fraction `power` of the mean; otherwise the comparison would have no power.
void expectSameMeans(const Means& a, const Means& b, const double power, const std::string& what) {
    for (std::size_t k = 0; k < Means::kCount; ++k) {
        const double error = std::hypot(a.error[k], b.error[k]);
        EXPECT_LE(std::abs(a.mean[k] - b.mean[k]), kLargestZ * error + 1e-6 * a.mean[k])
            << what << ", quarter and channel " << k << ": " << a.mean[k] << " and " << b.mean[k] << " +- "
            << error;
        EXPECT_LE(error, power * a.mean[k] + 1e-6) << what << " " << k;
    }
}

void expectSameByEveryStrategy(const PathScene& made, const PathWork& work, const double power) {
    const auto with = [&](const std::uint32_t strategies, const std::uint32_t firstSeed) {
        PathWork changed = work;
        changed.strategies = strategies;
        return meansOf(made, changed, firstSeed);
    };
    const Means both = with(kSampleLights | kSampleBsdf, 1000);
    expectSameMeans(both, with(kSampleLights, 2000), power, "light sampling");
    expectSameMeans(both, with(kSampleBsdf, 3000), power, "BSDF sampling");
}

Material plastic(const glm::vec3 color, const float roughness) {
    Material material;
    material.baseColorFactor = glm::vec4(color, 1.0f);
    material.metallicFactor = 0.0f;
    material.roughnessFactor = roughness;
    return material;
}

// Returns two lights of different size and colour over a glossy floor with two balls, one of rough metal and
// one diffuse.
PathScene quadsOverFloor() {
    PathScene made;
    Scene& scene = made.scene;
    addQuad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, addMaterial(scene, plastic({0.6f, 0.5f, 0.4f}, 0.3f)));
    addQuad(scene, {-1, 1.5f, -0.5f}, {1, 0, 0}, {0, 0, 1}, addMaterial(scene, emitter({4, 3, 2})));
    addQuad(scene, {0.7f, 1.2f, -0.2f}, {0.5f, 0, 0}, {0, 0.3f, 0.5f},
            addMaterial(scene, emitter({1, 4, 9})));
    addBall(scene, {-0.6f, 0.4f, 0.0f}, 0.4f, addMaterial(scene, metal({0.9f, 0.7f, 0.3f}, 0.4f)), true, 16);
    addBall(scene, {0.5f, 0.35f, 0.3f}, 0.35f, addMaterial(scene, lambert({0.3f, 0.6f, 0.8f})), true, 16);
    made.view = lookAt({0.5f, 1.2f, 3.0f}, {0, 0.4f, 0}, {0, 1, 0});
    return made;
}

// Returns lamps of many triangles, among which the tree of lights chooses, around a glossy box. Two of them
// shine to both sides, and one shines away from all.
PathScene manyLamps() {
    PathScene made;
    Scene& scene = made.scene;
    addQuad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, addMaterial(scene, plastic({0.6f, 0.5f, 0.4f}, 0.4f)));
    addBox(scene, {-0.4f, 0, -0.4f}, {0.4f, 0.6f, 0.4f}, addMaterial(scene, metal({0.9f, 0.7f, 0.3f}, 0.4f)));
    addBall(scene, {-1.2f, 0.7f, 0.4f}, 0.2f, addMaterial(scene, emitter({6, 3, 2})), false, 8);
    Material sheet = emitter({1, 3, 5});
    sheet.doubleSided = true;
    const std::uint32_t both = addMaterial(scene, sheet);
    addQuad(scene, {1.0f, 0.2f, -0.5f}, {0.1f, 0.4f, 0}, {0, 0, 0.6f}, both);
    addQuad(scene, {0.2f, 1.4f, 0.3f}, {0.5f, 0, 0.1f}, {0, 0.1f, 0.3f}, both);
    addQuad(scene, {-0.5f, 2, -1.5f}, {0.4f, 0, 0}, {0, 0.4f, 0}, addMaterial(scene, emitter({9, 1, 1})));
    made.view = lookAt({0.5f, 1.2f, 3.0f}, {0, 0.4f, 0}, {0, 1, 0});
    return made;
}

// Returns two balls under an environment map with a bright patch and a lamp; both are in the light table. The
// map's tables leave all but the patch to BSDF sampling, also where only lights are sampled.
PathScene ballsUnderMap() {
    PathScene made;
    Scene& scene = made.scene;
    addQuad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, addMaterial(scene, plastic({0.6f, 0.5f, 0.4f}, 0.5f)));
    addBall(scene, {-0.6f, 0.4f, 0.0f}, 0.4f, addMaterial(scene, metal({0.9f, 0.7f, 0.3f}, 0.5f)), true, 16);
    addBall(scene, {0.5f, 0.35f, 0.3f}, 0.35f, addMaterial(scene, lambert({0.3f, 0.6f, 0.8f})), true, 16);
    addQuad(scene, {-1, 1.5f, -0.5f}, {1, 0, 0}, {0, 0, 1}, addMaterial(scene, emitter({4, 3, 2})));
    Environment map;
    map.width = 32;
    map.height = 16;
    for (std::uint32_t y = 0; y < map.height; ++y) {
        for (std::uint32_t x = 0; x < map.width; ++x) {
            const bool isBright = y >= 3 && y < 6 && x >= 20 && x < 24;
            map.texels.push_back(isBright ? glm::vec3(60, 40, 20)
                                          : glm::vec3(0.2f, 0.4f, 0.05f * static_cast<float>(16 - y)));
        }
    }
    made.surroundings.environment = map;
    made.surroundings.rotation = 0.7f;
    made.surroundings.intensity = 1.5f;
    made.view = lookAt({0.5f, 1.2f, 3.0f}, {0, 0.4f, 0}, {0, 1, 0});
    return made;
}

// Returns a closed room with a lamp below its ceiling and two boxes.
PathScene room() {
    PathScene made;
    Scene& scene = made.scene;
    addBox(scene, {-1, 0, -1}, {1, 2, 1}, addMaterial(scene, lambert({0.7f, 0.5f, 0.3f})), Facing::inwards);
    addQuad(scene, {-0.5f, 1.95f, -0.5f}, {1, 0, 0}, {0, 0, 1}, addMaterial(scene, emitter({5, 5, 5})));
    addBox(scene, {-0.7f, 0, -0.6f}, {-0.1f, 1.1f, 0.0f}, addMaterial(scene, lambert({0.8f, 0.8f, 0.8f})));
    addBox(scene, {0.2f, 0, 0.0f}, {0.7f, 0.5f, 0.5f}, addMaterial(scene, metal({0.8f, 0.8f, 0.8f}, 0.5f)));
    made.view = lookAt({0, 1.0f, 0.95f}, {0, 0.8f, -1}, {0, 1, 0});
    made.view.verticalFov = 1.2f;
    return made;
}

TEST(PathUnbiased, quadsOverAGlossyFloor) {
    expectSameByEveryStrategy(quadsOverFloor(), {.samples = 128, .maxBounces = 4}, 0.02);
}

TEST(PathUnbiased, treeOfLamps) {
    expectSameByEveryStrategy(manyLamps(), {.samples = 192, .maxBounces = 4}, 0.02);
}

TEST(PathUnbiased, mapWithABrightPatch) {
    expectSameByEveryStrategy(ballsUnderMap(), {.samples = 128, .maxBounces = 4}, 0.02);
}

TEST(PathUnbiased, panesBelowALampAndAMap) {
    PathScene made = ballsUnderMap();
    Material pane = glass(1.5f, 0.0f);
    pane.thicknessFactor = 0.0f;
    pane.baseColorFactor = {0.9f, 0.8f, 0.6f, 1.0f};
    const std::uint32_t material = addMaterial(made.scene, pane);
    addQuad(made.scene, {-1.5f, 1.1f, -1.0f}, {2.5f, 0, 0}, {0, 0, 2}, material);
    addQuad(made.scene, {-1.5f, 1.3f, -1.0f}, {2.5f, 0, 0}, {0, 0, 2}, material);
    addQuad(made.scene, {1.0f, 0.0f, -1.0f}, {0, 0, 2}, {0, 1.1f, 0}, material);
    expectSameByEveryStrategy(made, {.samples = 128, .maxBounces = 4}, 0.02);
}

TEST(PathUnbiased, closedRoom) { expectSameByEveryStrategy(room(), {.samples = 128, .maxBounces = 6}, 0.02); }

} // namespace
} // namespace metamarch::tests
