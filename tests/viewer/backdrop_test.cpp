// SPDX-License-Identifier: MIT
#include "metamarch/shared/scene_light.h"
#include "metamarch/viewer/backdrop.h"

#include <gtest/gtest.h>

namespace metamarch::viewer {
namespace {

constexpr std::uint32_t kWidth = 16;
constexpr std::uint32_t kHeight = 8;

// A map of one colour, turned by a quarter.
ShadingScene surrounded(const glm::vec3 color) {
    ShadingScene scene;
    scene.features = kFeatureEnvironment | kFeatureNormalMaps;
    scene.settings.environmentWidth = kWidth;
    scene.settings.environmentHeight = kHeight;
    scene.settings.environmentScale = 2.0f;
    scene.settings.environmentSine = 1.0f;
    scene.settings.environmentCosine = 0.0f;
    scene.environment.assign(std::size_t{kWidth} * kHeight, glm::vec4(color, 1.0f));
    return scene;
}

glm::vec3 lightFrom(const ShadingScene& scene, const glm::vec3 direction) {
    return environmentLight(scene, scene.settings, glm::normalize(direction), 0).radiance;
}

constexpr glm::vec3 kDirections[] = {{0, 0, 1},   {1, 0, 0},        {0, 0, -1},      {-1, 0, 0},
                                     {0.1, 1, 0}, {-0.2, -1, 0.1f}, {1, 0.7f, -0.4f}};

TEST(BlurredSurroundings, keepOneColour) {
    const ShadingScene blurred = blurredSurroundings(surrounded({0.5f, 1.0f, 3.0f}));
    for (const glm::vec3& direction : kDirections) {
        const glm::vec3 light = lightFrom(blurred, direction);
        EXPECT_NEAR(light.x, 1.0f, 1e-4f);
        EXPECT_NEAR(light.y, 2.0f, 1e-4f);
        EXPECT_NEAR(light.z, 6.0f, 1e-4f);
    }
}

TEST(BlurredSurroundings, areBrightestWhereTheMapIs) {
    ShadingScene scene = surrounded({0.0f, 0.0f, 0.0f});
    scene.environment[std::size_t{kWidth} * 3 + 5] = glm::vec4(100.0f);
    const glm::vec3 towards = turnedFromMap(scene.settings, mapDirection({5.5f / kWidth, 3.5f / kHeight}));
    const ShadingScene blurred = blurredSurroundings(scene);
    const float middle = lightFrom(blurred, towards).x;
    EXPECT_LT(middle, lightFrom(scene, towards).x);
    EXPECT_GT(middle, 0.1f * lightFrom(scene, towards).x);
    for (const glm::vec3& direction : kDirections) {
        EXPECT_LT(lightFrom(blurred, towards + 0.2f * direction).x, middle);
    }
    EXPECT_LT(lightFrom(blurred, -towards).x, 1e-3f * middle);
}

TEST(BlurredSurroundings, areTheBackgroundWithoutAMap) {
    ShadingScene scene;
    scene.settings.background = {0.1f, 0.2f, 0.3f};
    EXPECT_EQ(lightFrom(blurredSurroundings(scene), {0, 1, 0}), scene.settings.background);
}

} // namespace
} // namespace metamarch::viewer
