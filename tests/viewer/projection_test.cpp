// SPDX-License-Identifier: MIT
// Compares the projection of points to the window with the rays through these pixels.
#include "metamarch/shading/view.h"
#include "metamarch/viewer/projection.h"

#include <gtest/gtest.h>

namespace metamarch::viewer {
namespace {

constexpr float kPixelSlack = 0.01f; // pixels

Camera looking(const bool isParallel, const CameraOptions& options = {}) {
    SceneCamera camera = lookAt({1, 2, 5}, {0.5f, 0, -1}, {0.1f, 1, 0});
    camera.verticalFov = 0.8f;
    if (isParallel) {
        camera.projection = SceneCamera::Projection::orthographic;
        camera.verticalExtent = 3.0f;
    }
    return makeCamera(camera, 320, 200, options);
}

glm::vec3 pointOn(const Camera& camera, const glm::vec2 place, const float distance) {
    const CameraRay ray = cameraRayThrough(camera, place, glm::vec2(0.0f));
    return ray.origin + ray.dir * distance;
}

TEST(Projection, isTheInverseOfCameraRays) {
    for (const bool isParallel : {false, true}) {
        const Camera camera = looking(isParallel);
        for (const glm::vec2 place : {glm::vec2(0, 0), glm::vec2(160, 100), glm::vec2(319.5f, 20.25f),
                                      glm::vec2(-40, 150), glm::vec2(33, 233)}) {
            for (const float distance : {0.1f, 3.0f, 500.0f}) {
                const glm::vec3 point = pointOn(camera, place, distance);
                const auto found = project(camera, point, point);
                ASSERT_TRUE(found.has_value());
                EXPECT_LT(glm::distance((*found)[0], place), kPixelSlack * std::max(1.0f, distance / 100.0f));
            }
        }
    }
}

TEST(Projection, cutsWhatIsBehindTheEye) {
    const Camera camera = looking(false);
    const glm::vec3 before = pointOn(camera, {200, 90}, 2.0f);
    const glm::vec3 aside = pointOn(camera, {300, 10}, 2.0f);
    const glm::vec3 behind = camera.eye - (aside - camera.eye);
    for (const bool isTurned : {false, true}) {
        const auto found = isTurned ? project(camera, behind, before) : project(camera, before, behind);
        ASSERT_TRUE(found.has_value());
        EXPECT_LT(glm::distance((*found)[isTurned ? 1 : 0], {200, 90}), kPixelSlack);
        // The other end is outside the picture, on the side opposite to its mirror image.
        const glm::vec2 end = (*found)[isTurned ? 0 : 1];
        EXPECT_LT(end.x, 0.0f);
        EXPECT_GT(end.y, 200.0f);
    }
    EXPECT_FALSE(project(camera, behind, behind - camera.forward).has_value());
    EXPECT_FALSE(project(camera, camera.eye, camera.eye).has_value());
}

TEST(Projection, ofPanoramasIsNone) {
    const Camera camera = looking(false, {.isPanorama = true});
    EXPECT_FALSE(project(camera, {0, 0, 0}, {1, 0, 0}).has_value());
}

} // namespace
} // namespace metamarch::viewer
