// SPDX-License-Identifier: MIT
// Masked and blended surfaces, seen directly and by their shadows.
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <numbers>

namespace metamarch::tests {
namespace {

constexpr PathWork kWork{.samples = 1024};
// Four standard errors of a mean of 64 * 1024 zeros and ones; one is at most 0.5 / sqrt(64 * 1024).
constexpr double kNoise = 0.008;
constexpr double kRounding = 2e-5; // relative rounding error of a sum of 1024 equal floats
const glm::dvec3 kColor(0.2, 0.6, 1.0);
const glm::dvec3 kBlack(0.0); // a black pane sends no light to the floor
const glm::dvec3 kBehind(1.0, 0.5, 0.25);

Material pane(const AlphaMode mode, const float alpha, const glm::dvec3 color = kColor) {
    Material material = unlit(glm::vec3(color));
    material.alphaMode = mode;
    material.baseColorFactor.a = alpha;
    return material;
}

void expectNear(const glm::dvec3 seen, const glm::dvec3 expected, const double tolerance) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(seen[c], expected[c], tolerance) << "channel " << c;
    }
}

// Returns the radiance through panes one behind the other, at z = 0, -1, ...
glm::dvec3 through(const Material& material, const int panes) {
    PathScene made;
    const std::uint32_t id = addMaterial(made.scene, material);
    for (int i = 0; i < panes; ++i) {
        addQuad(made.scene, {-9, -9, -i}, {18, 0, 0}, {0, 18, 0}, id);
    }
    made.surroundings.background = glm::vec3(kBehind);
    return probe(made, {0.2f, 0.1f, 3}, {0.2f, 0.1f, 0}, kWork);
}

TEST(PathAlpha, blendedPaneIsThereInPart) {
    expectNear(through(pane(AlphaMode::blend, 0.3f), 1), 0.3 * kColor + 0.7 * kBehind, kNoise);
    expectNear(through(pane(AlphaMode::blend, 0.3f), 2), 0.51 * kColor + 0.49 * kBehind, kNoise);
    expectNear(through(pane(AlphaMode::blend, 1.0f), 1), kColor, kRounding);
    expectNear(through(pane(AlphaMode::blend, 0.0f), 1), kBehind, kRounding);
    expectNear(through(pane(AlphaMode::opaque, 0.3f), 1), kColor, kRounding);
}

TEST(PathAlpha, maskIsThereOrNot) {
    Material material = pane(AlphaMode::mask, 0.4f);
    material.alphaCutoff = 0.5f;
    expectNear(through(material, 1), kBehind, kRounding);
    material.alphaCutoff = 0.4f;
    expectNear(through(material, 1), kColor, kRounding);
}

// The alphas of texture, vertex colour and factor are multiplied. x selects one of two texels.
TEST(PathAlpha, textureAndVertexColourCount) {
    for (const auto& [x, alpha] : {std::pair(-0.5f, 0.2), std::pair(0.5f, 1.0)}) {
        PathScene made;
        Material material = pane(AlphaMode::blend, 0.5f);
        material.baseColorTexture.texture =
            addTexture(made.scene, 2, {{255, 255, 255, 51}, {255, 255, 255, 255}}, TextureFilter::nearest);
        addQuad(made.scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, addMaterial(made.scene, material));
        made.scene.colors.assign(4, {1.0f, 1.0f, 1.0f, 0.8f});
        made.surroundings.background = glm::vec3(kBehind);
        const double part = 0.5 * 0.8 * alpha;
        expectNear(probe(made, {x, 0, 3}, {x, 0, 0}, kWork), part * kColor + (1.0 - part) * kBehind, kNoise);
    }
}

// Returns the radiance of a floor under a light, which is a directional one if `isFar`, with `panes` panes of
// the material between them. Without panes it is 1.
double floorBehind(const Material& material, const int panes, const bool isFar) {
    PathScene made;
    addQuad(made.scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10},
            addMaterial(made.scene, lambert(glm::vec3(1.0f))));
    const std::uint32_t id = addMaterial(made.scene, material);
    for (int i = 1; i <= panes; ++i) {
        const float y = 0.2f * static_cast<float>(i);
        addQuad(made.scene, {-0.3f, y, 0.3f}, {0.6f, 0, 0}, {0, 0, -0.6f}, id);
    }
    if (isFar) {
        PunctualLight light;
        light.type = PunctualLight::Type::directional;
        light.direction = {0, -1, 0};
        light.intensity = std::numbers::pi_v<float>;
        made.scene.lights.push_back(light);
    } else {
        addPointLight(made.scene, {0, 1, 0}, std::numbers::pi_v<float>);
    }
    return probe(made, {2.0f, 0.3f, 0.0f}, {0, 0, 0}, {.samples = kWork.samples, .maxBounces = 0}).r;
}

TEST(PathAlpha, shadowLetsThroughWhatTheSurfaceDoes) {
    for (const bool isFar : {false, true}) {
        EXPECT_NEAR(floorBehind(pane(AlphaMode::blend, 0.3f, kBlack), 0, isFar), 1.0, kRounding);
        EXPECT_NEAR(floorBehind(pane(AlphaMode::blend, 0.3f, kBlack), 1, isFar), 0.7, kNoise);
        EXPECT_NEAR(floorBehind(pane(AlphaMode::blend, 0.3f, kBlack), 2, isFar), 0.49, kNoise);
        EXPECT_EQ(floorBehind(pane(AlphaMode::opaque, 0.3f, kBlack), 1, isFar), 0.0);
        Material mask = pane(AlphaMode::mask, 0.3f, kBlack);
        EXPECT_NEAR(floorBehind(mask, 1, isFar), 1.0, kRounding);
        mask.alphaCutoff = 0.2f;
        EXPECT_EQ(floorBehind(mask, 1, isFar), 0.0);
    }
}

// A blended emitter emits in proportion to its alpha, whichever strategy finds it.
TEST(PathAlpha, blendedEmitterShinesByItsPart) {
    const auto floorUnder = [](const float alpha, const std::uint32_t strategies) {
        PathScene made;
        addQuad(made.scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10},
                addMaterial(made.scene, lambert(glm::vec3(1.0f))));
        Material light = emitter(glm::vec3(1.0f));
        light.alphaMode = AlphaMode::blend;
        light.baseColorFactor.a = alpha;
        addQuad(made.scene, {-1, 0.7f, -1}, {2, 0, 0}, {0, 0, 2}, addMaterial(made.scene, light));
        return probe(made, {2.0f, 0.3f, 0.0f}, {0, 0, 0},
                     {.samples = 1024, .maxBounces = 0, .strategies = strategies})
            .r;
    };
    const double whole = floorUnder(1.0f, kSampleLights);
    for (const std::uint32_t strategies : {kSampleLights | kSampleBsdf, kSampleLights, kSampleBsdf}) {
        EXPECT_NEAR(floorUnder(0.3f, strategies), 0.3 * whole, kNoise) << strategies;
    }
}

} // namespace
} // namespace metamarch::tests
