// SPDX-License-Identifier: MIT
// White furnaces of the path tracer: under uniform light of radiance 1, an object that absorbs nothing is
// invisible. The tolerances are those of the material model's fitted albedos
// (tests/shading/bsdf_energy_test); for materials without such a fit, they are the noise.
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamarch::tests {
namespace {

constexpr PathWork kWork{.samples = 64, .maxBounces = 64, .side = 24};

// Returns a tessellated ball under uniform light of radiance 1. It fills the picture except for its corners.
PathScene furnaceOf(const Material& material) {
    PathScene made;
    addBall(made.scene, glm::vec3(0.0f), 1.0f, addMaterial(made.scene, material));
    made.surroundings.background = glm::vec3(1.0f);
    made.view = lookAt({0.3f, 0.5f, 4.0f}, glm::vec3(0.0f), {0, 1, 0});
    made.view.verticalFov = 0.5f;
    return made;
}

double furnace(const Material& material, const PathWork& work = kWork) {
    const std::vector<FilmPixel> film = render(furnaceOf(material), work);
    EXPECT_EQ(rejectedOf(film), 0u);
    return coveredMeanOf(film).g;
}

std::string describe(const float roughness) { return "roughness " + std::to_string(roughness); }

// With cosine sampling each path has exactly the weight of its albedo, so there is no noise.
TEST(PathFurnace, lambertReflectsItsAlbedo) {
    for (const float albedo : {1.0f, 0.5f, 0.18f}) {
        EXPECT_NEAR(furnace(lambert(glm::vec3(albedo))), albedo, 1e-5) << albedo;
    }
}

TEST(PathFurnace, whiteDielectricOverDiffuse) {
    for (int i = 0; i <= 10; i += 2) {
        Material material;
        material.metallicFactor = 0.0f;
        material.roughnessFactor = 0.1f * static_cast<float>(i);
        EXPECT_NEAR(furnace(material), 1.0, 0.005) << describe(material.roughnessFactor);
    }
}

TEST(PathFurnace, metalOfEveryRoughness) {
    for (int i = 0; i <= 10; ++i) {
        const float roughness = 0.1f * static_cast<float>(i);
        EXPECT_NEAR(furnace(metal(glm::vec3(1.0f), roughness)), 1.0, 0.005) << describe(roughness);
    }
}

TEST(PathFurnace, glassWithAVolume) {
    // Some light stays inside the faceted ball for long: 0.3 % of it for 64 bounces, none for 256.
    PathWork patient = kWork;
    patient.maxBounces = 256;
    EXPECT_NEAR(furnace(glass(1.5f, 0.0f), patient), 1.0, 1e-4);
    // A path meets rough glass several times, each time within the error of glassAlbedo; at most 1.4 % were
    // measured.
    for (int i = 2; i <= 10; i += 2) {
        const float roughness = 0.1f * static_cast<float>(i);
        EXPECT_NEAR(furnace(glass(1.5f, roughness)), 1.0, 0.02) << describe(roughness);
    }
}

TEST(PathFurnace, thinGlass) {
    for (int i = 0; i <= 10; i += 2) {
        Material material = glass(1.5f, 0.1f * static_cast<float>(i));
        material.thicknessFactor = 0.0f;
        PathWork many = kWork;
        many.samples = 256; // at roughness 1 the noise of 64 is 0.3 %
        EXPECT_NEAR(furnace(material, many), 1.0, 0.005) << describe(material.roughnessFactor);
    }
}

TEST(PathFurnace, diffuseTransmission) {
    Material material = lambert(glm::vec3(1.0f));
    material.diffuseTransmissionFactor = 0.4f;
    EXPECT_NEAR(furnace(material), 1.0, 0.005);
}

TEST(PathFurnace, coat) {
    for (const float coatRoughness : {0.0f, 0.3f, 0.8f}) {
        Material material = lambert(glm::vec3(1.0f));
        material.clearcoatFactor = 1.0f;
        material.clearcoatRoughnessFactor = coatRoughness;
        EXPECT_NEAR(furnace(material), 1.0, 0.005) << describe(coatRoughness);
    }
}

// The sheen's albedo, which darkens the layer below, is rounded up: at most 1.8 % are lost, and nothing is
// gained.
TEST(PathFurnace, sheen) {
    for (const float sheenRoughness : {0.2f, 0.5f, 1.0f}) {
        Material material = lambert(glm::vec3(1.0f));
        material.sheenColorFactor = glm::vec3(1.0f);
        material.sheenRoughnessFactor = sheenRoughness;
        EXPECT_GT(furnace(material), 0.982) << describe(sheenRoughness);
        EXPECT_LT(furnace(material), 1.005) << describe(sheenRoughness);
    }
}

TEST(PathFurnace, iridescentMetal) {
    Material filmed = metal(glm::vec3(1.0f), 0.2f);
    filmed.iridescenceFactor = 1.0f;
    EXPECT_NEAR(furnace(filmed), 1.0, 0.005);
}

// Each path keeps one channel and counts it three times. The tolerance is four standard errors; one is
// sqrt(2) / sqrt(150,000 samples).
TEST(PathFurnace, dispersiveGlass) {
    Material dispersive = glass(1.5f, 0.0f);
    dispersive.dispersion = 1.0f;
    PathWork work = kWork;
    work.samples = 512;
    const glm::dvec3 mean = coveredMeanOf(render(furnaceOf(dispersive), work));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(mean[c], 1.0, 0.015) << c;
    }
}

// The BRDF `gltf` loses the light that is scattered more than once. At normal incidence the loss is that of
// two other renderers (../shared/references/README.md), to the two digits given there.
TEST(PathFurnace, singleScatterMetalsLoseWhatOthersSayTheyLose) {
    constexpr double kExpected[] = {1.0, 1.0, 0.97, 0.82, 0.56, 0.31};
    for (int i = 0; i < 6; ++i) {
        PathScene made;
        const float roughness = 0.2f * static_cast<float>(i);
        addQuad(made.scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0},
                addMaterial(made.scene, metal(glm::vec3(1.0f), roughness)));
        made.surroundings.background = glm::vec3(1.0f);
        made.options.isSingleScatter = true;
        EXPECT_NEAR(probe(made, {0, 0, 3}, {0, 0, 0}, {.samples = 1024}).r, kExpected[i], 0.01)
            << describe(roughness);
    }
}

// In a closed room that emits E and has the albedo a, the radiance is E (1 + a + a^2 + ...); up to bounce n
// it is the sum of the first n + 2 terms. Russian roulette ends most of the long paths. Light sampling alone
// is left out, because its variance is not finite where walls meet.
TEST(PathFurnace, closedRoomIsAGeometricSeries) {
    const glm::dvec3 albedo(0.8, 0.5, 0.3);
    constexpr double kRadiance = 0.25;
    PathScene made;
    Material wall = lambert(glm::vec3(albedo));
    wall.emissiveFactor = glm::vec3(kRadiance);
    addBox(made.scene, {-1, -2, -1}, {1, 1, 2}, addMaterial(made.scene, wall), Facing::inwards);
    made.view = lookAt({0.3f, 0.5f, 1.0f}, glm::vec3(0.0f), {0, 1, 0});
    for (const std::uint32_t strategies : {kSampleLights | kSampleBsdf, kSampleBsdf}) {
        for (const std::uint32_t bounces : {0u, 1u, 3u, 1000u}) {
            const auto film = render(made, {.samples = 256, .maxBounces = bounces, .strategies = strategies});
            const glm::dvec3 mean = meanOf(film);
            for (int c = 0; c < 3; ++c) {
                const double terms = bounces + 2.0;
                const double sum = kRadiance * (1.0 - std::pow(albedo[c], terms)) / (1.0 - albedo[c]);
                EXPECT_NEAR(mean[c], sum, 0.005 * sum) << c << " " << bounces << " " << strategies;
            }
        }
    }
}

} // namespace
} // namespace metamarch::tests
