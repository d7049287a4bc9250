// SPDX-License-Identifier: MIT
#include "fixtures/shapes.h"
#include "metamarch/bench/views.h"
#include "metamarch/shared/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace metamarch::bench {
namespace {

TEST(Views, standWhereTheIssueSays) {
    const Scene scene = tests::unitCube();
    const float diagonal = std::sqrt(3.0f);
    for (const AxisView& view : kAxisViews) {
        const SceneCamera camera = axisCamera(scene, view, 1.5f);
        EXPECT_NEAR(glm::length(camera.eye - glm::vec3(0.5f)), 1.5f * diagonal, 1e-5f) << view.name;
        EXPECT_EQ(camera.forward, -view.from) << view.name;
        EXPECT_EQ(camera.verticalFov, kDefaultVerticalFov);
    }
}

// Every vertex is in the picture, and one is at its edge.
TEST(Views, fillThePicture) {
    Scene scene;
    tests::addSphere(scene, {100, 50, -20}, 3.0f, 48, 24);
    constexpr float kAspect = 4.0f / 3.0f;
    for (const AxisView& view : kAxisViews) {
        const SceneCamera camera = fillingCamera(scene, view, kAspect);
        const float slope = std::tan(0.5f * camera.verticalFov);
        const glm::vec3 right = glm::cross(camera.forward, camera.up);
        float outermost = 0.0f;
        for (const glm::vec3 position : scene.positions) {
            const glm::vec3 p = position - camera.eye;
            const float depth = glm::dot(p, camera.forward);
            ASSERT_GT(depth, 0.0f);
            outermost = std::max({outermost, std::abs(glm::dot(p, camera.up)) / (depth * slope),
                                  std::abs(glm::dot(p, right)) / (depth * slope * kAspect)});
        }
        EXPECT_NEAR(outermost, 1.0f, 1e-4f) << view.name;
    }
}

TEST(Views, lookAtAnEmptyScene) {
    for (const AxisView& view : kAxisViews) {
        EXPECT_TRUE(std::isfinite(fillingCamera({}, view, 1.0f).eye.z));
        EXPECT_TRUE(std::isfinite(axisCamera({}, view, 0.7f).eye.z));
    }
}

} // namespace
} // namespace metamarch::bench
