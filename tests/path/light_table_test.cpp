// SPDX-License-Identifier: MIT
// The table from which light sampling draws, and the densities for multiple importance sampling.
#include "metamarch/shading/light/sky.h"
#include "metamarch/shared/path.h"
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <span>

namespace metamarch::tests {
namespace {

// Returns a scene with lights of every kind.
PathScene manyLights() {
    PathScene made;
    addBall(made.scene, {0, 1, 0}, 0.5f, addMaterial(made.scene, emitter({3, 2, 1})), false, 12);
    Material panel = emitter({1, 2, 8});
    panel.doubleSided = true;
    addQuad(made.scene, {-3, 2, -1}, {0.3f, 0, 0}, {0, 0.2f, 1}, addMaterial(made.scene, panel));
    addQuad(made.scene, {-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, addMaterial(made.scene, lambert(glm::vec3(1))));
    addPointLight(made.scene, {1, 3, 0}, 5.0f);
    Sky sky = makeSky({.resolution = 32});
    made.surroundings.environment = sky.environment;
    made.surroundings.rotation = 0.4f;
    made.surroundings.sun = sky.sun;
    return made;
}

// Returns two triangles that shine, too few for a tree, over a floor that does not.
PathScene fewLights() {
    PathScene made;
    addFacet(made.scene, {0, 2, 0}, {1, 2, 0}, {0, 2, 3}, {0, 9, 0},
             addMaterial(made.scene, emitter({3, 2, 1})));
    Material panel = emitter({1, 2, 8});
    panel.doubleSided = true;
    addFacet(made.scene, {-3, 2, 0}, {-4, 2, 1}, {-3, 3, 1}, {0, 9, 0}, addMaterial(made.scene, panel));
    addQuad(made.scene, {-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, addMaterial(made.scene, lambert(glm::vec3(1))));
    return made;
}

TEST(PathLightTable, probabilitiesSumToOne) {
    const ShadingScene shading = shadingOf(manyLights());
    const std::span table(shading.tables.data(), shading.settings.lightCount);
    double sum = 0.0;
    for (const TableEntry& entry : table) {
        EXPECT_NEAR(static_cast<double>(entry.upTo) - entry.from, entry.probability, 1e-7);
        sum += entry.probability;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_EQ(table.back().probability, shading.settings.environmentProbability);
}

TEST(PathLightTable, densityTimesAreaIsTheShareOfAMaterial) {
    const ShadingScene shading = shadingOf(fewLights());
    ASSERT_EQ(shading.features & kFeatureLightTree, 0u);
    std::map<std::uint32_t, double> shares;
    std::map<std::uint32_t, double> areas;
    for (std::size_t i = 0; i < shading.emitters.size(); ++i) {
        const Emitter& emitter = shading.emitters[i];
        const glm::dvec3 v0(emitter.v0);
        areas[emitter.material] +=
            0.5 * glm::length(glm::cross(glm::dvec3(emitter.v1) - v0, glm::dvec3(emitter.v2) - v0));
        shares[emitter.material] += shading.tables[i].probability;
    }
    ASSERT_EQ(shares.size(), 2u);
    for (const auto& [material, share] : shares) {
        EXPECT_GT(share, 0.0);
        EXPECT_NEAR(shading.materials[material].emissionDensity * areas[material], share, 1e-5 * share);
    }
    EXPECT_EQ(shading.materials[2].emissionDensity, 0.0f); // does not shine
}

// The integral of the map's density over the sphere is the probability that light sampling chooses the map.
TEST(PathLightTable, densityOfTheMapIsAShareToo) {
    const ShadingScene shading = shadingOf(manyLights());
    const uint bin = normalBin(glm::vec3(0.0f, 0.6f, 0.8f));
    constexpr int kRows = 512;
    double sum = 0.0;
    for (int y = 0; y < kRows; ++y) {
        const double polar = std::numbers::pi * (y + 0.5) / kRows;
        for (int x = 0; x < 2 * kRows; ++x) {
            const double azimuth = std::numbers::pi * (x + 0.5) / kRows;
            const glm::vec3 direction(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                      std::sin(polar) * std::sin(azimuth));
            sum += environmentLight(shading, shading.settings, direction, bin).pdf * std::sin(polar);
        }
    }
    sum *= std::numbers::pi / kRows * std::numbers::pi / kRows;
    EXPECT_NEAR(sum, shading.settings.environmentProbability, 0.002 * sum);
}

// Light sampling and a ray that hits the light at the same point compute the same density.
void expectSameDensityByBothWays(const ShadingScene& shading) {
    const bool isFarKnown = shading.settings.sunIndex != kNoSun;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> even(0.0f, 1.0f);
    const LightReceiver to(glm::vec3(0.3f, 0.1f, 0.7f), glm::vec3(0.0f, 0.8f, 0.6f));
    const uint bin = normalBin(to.normal);
    int emitters = 0;
    int far = 0;
    int atEdge = 0;
    for (int i = 0; i < 20'000; ++i) {
        const glm::vec2 u(std::min(even(random), 0.99999994f), even(random));
        const SceneLightSample sample = sampleSceneLight(shading, shading.settings, to, bin, u);
        ASSERT_NEAR(glm::length(sample.wi), 1.0f, 1e-5f);
        if (sample.pdf == 0.0f) {
            continue; // a point light
        }
        if (sample.isFar) {
            const LightRecord& sun = shading.lights[shading.settings.sunIndex];
            const float inMap = environmentLight(shading, shading.settings, sample.wi, bin).pdf;
            const float chance =
                shading.tables[punctualEntry(shading, shading.settings, shading.settings.sunIndex)]
                    .probability;
            const float ofSun = chance / (kTwoPi * sun.scale);
            const bool isSame = std::abs(sample.pdf - inMap) < 1e-3f * inMap ||
                                (hitsDisc(sun, sample.wi) && std::abs(sample.pdf - ofSun) < 1e-4f * ofSun);
            atEdge += isSame ? 0 : 1;
            ++far;
            continue;
        }
        const uint chosen = chooseLight(shading, shading.settings, to, u.x).index;
        const Emitter& emitter = shading.emitters[chosen];
        const glm::dvec3 v0(emitter.v0);
        const glm::dvec3 normal =
            glm::normalize(glm::cross(glm::dvec3(emitter.v1) - v0, glm::dvec3(emitter.v2) - v0));
        const double cosine = glm::dot(normal, glm::dvec3(sample.wi));
        const double t = glm::dot(normal, v0 - glm::dvec3(to.position)) / cosine;
        const bool isInTree = (shading.features & kFeatureLightTree) != 0u;
        const float chance =
            isInTree ? chanceOfEmitter(shading, shading.settings, to, emitter.triangleId).probability : 0.0f;
        const TriangleRecord triangle{emitter.v0, emitter.triangleId, emitter.v1, 0, emitter.v2, 0};
        const double density =
            emitterDensity(shading, shading.materials[emitter.material], triangle, chance) * t * t /
            std::abs(cosine);
        if (std::abs(cosine) > 0.01) {
            ASSERT_NEAR(sample.pdf, density, 1e-3 * density) << i;
            ++emitters;
        }
    }
    EXPECT_GT(emitters, 1000);
    EXPECT_TRUE(far > 1000 || !isFarKnown);
    EXPECT_LE(atEdge, far / 1000) << "too many samples were rounded to the next texel of the map";
}

TEST(PathLightTable, bothWaysNameTheSameDensity) {
    expectSameDensityByBothWays(shadingOf(fewLights()));
    const ShadingScene many = shadingOf(manyLights());
    ASSERT_NE(many.features & kFeatureLightTree, 0u);
    expectSameDensityByBothWays(many);
}

TEST(PathLightTable, weightsOfBothWaysSumToOne) {
    PathSettings settings{};
    settings.strategies = kSampleLights | kSampleBsdf;
    std::mt19937 random(9);
    std::uniform_real_distribution<float> exponent(-12.0f, 12.0f);
    for (int i = 0; i < 10'000; ++i) {
        const float byBsdf = std::pow(10.0f, exponent(random));
        const float byLights = std::pow(10.0f, exponent(random));
        for (const bool isMap : {false, true}) {
            ASSERT_NEAR(foundWeight(settings, byBsdf, byLights, isMap) +
                            sampledWeight(settings, byLights, byBsdf, isMap),
                        1.0f, 1e-6f)
                << byBsdf << " " << byLights;
        }
    }
    EXPECT_EQ(foundWeight(settings, kCertain, 1.0f, true), 1.0f); // seen by the camera or in a mirror
    EXPECT_EQ(foundWeight(settings, 1.0f, 0.0f, true), 1.0f);     // unknown to light sampling
    EXPECT_EQ(sampledWeight(settings, 0.0f, 1.0f, true), 1.0f);   // a point light
    EXPECT_EQ(sampledWeight(settings, 1.0f, 0.0f, true), 1.0f);

    settings.strategies = kSampleLights;
    EXPECT_EQ(foundWeight(settings, 1.0f, 2.0f, true) + sampledWeight(settings, 2.0f, 1.0f, true), 1.0f);
    EXPECT_EQ(foundWeight(settings, kCertain, 2.0f, true), 1.0f);
    settings.strategies = kSampleBsdf;
    EXPECT_EQ(foundWeight(settings, 1.0f, 2.0f, true), 1.0f); // there is no light sampling
}

} // namespace
} // namespace metamarch::tests
