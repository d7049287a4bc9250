// SPDX-License-Identifier: MIT
// The camera of a picture, and its rays.
#include "fixtures/expect_error.h"
#include "metamarch/shading/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace metamarch::tests {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr double kRounding = 1e-6; // a few ulps of a number near 1

SceneCamera named(const char* name) {
    SceneCamera camera;
    camera.name = name;
    return camera;
}

Scene withCameras() {
    Scene scene;
    scene.cameras = {named("front"), named("2"), named("top view"), named("0x")};
    return scene;
}

TEST(SelectCamera, byIndexBeforeName) {
    const Scene scene = withCameras();
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        EXPECT_EQ(&selectCamera(scene, std::to_string(i)), &scene.cameras[i]);
    }
}

TEST(SelectCamera, byName) {
    const Scene scene = withCameras();
    EXPECT_EQ(&selectCamera(scene, "front"), &scene.cameras[0]);
    EXPECT_EQ(&selectCamera(scene, "top view"), &scene.cameras[2]);
    EXPECT_EQ(&selectCamera(scene, "0x"), &scene.cameras[3]);
}

TEST(SelectCamera, refusesOthersAndListsItsOwn) {
    const Scene scene = withCameras();
    for (const char* const selection : {"4", "-1", "fron", "Front", "", "99999999999999999999", "1 "}) {
        expectError(ErrorKind::invalidArgument, "the scene has 0 'front', 1 '2', 2 'top view', 3 '0x'",
                    {"camera"}, [&] { selectCamera(scene, selection); });
    }
    expectError(ErrorKind::invalidArgument, "there is no camera 4;", [&] { selectCamera(scene, "4"); });
}

TEST(SelectCamera, saysWhatToDoWithoutCameras) {
    expectError(ErrorKind::invalidArgument, "camera 0: the scene has no camera; give eye and target",
                {"camera", "eye", "target"}, [] { selectCamera(Scene{}, "0"); });
}

TEST(LookAt, hasOrthonormalAxesTowardsTheTarget) {
    const glm::vec3 eye(1, 2, 3);
    const glm::vec3 target(4, -1, 0);
    for (const float scale : {1e-20f, 1.0f, 1e20f}) {
        const SceneCamera camera = lookAt(eye * scale, target * scale, glm::vec3(0.1f, 1, 0) * scale);
        EXPECT_EQ(camera.eye, eye * scale);
        EXPECT_EQ(camera.verticalFov, kDefaultVerticalFov);
        EXPECT_NEAR(glm::length(camera.forward), 1.0, kRounding);
        EXPECT_NEAR(glm::length(camera.up), 1.0, kRounding);
        EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0.0, kRounding);
        EXPECT_NEAR(glm::dot(camera.forward, glm::normalize(target - eye)), 1.0, kRounding);
        EXPECT_GT(camera.up.y, 0.0f);
    }
}

TEST(LookAt, refusesOnePointForBoth) {
    expectError(ErrorKind::invalidArgument, "eye and target are the same point", {"eye", "target"}, [] {
        lookAt({1, 2, 3}, {1, 2, 3}, {0, 1, 0});
    });
}

TEST(LookAt, refusesUpAlongTheView) {
    const glm::vec3 view(1, 2, -2);
    for (const glm::vec3 up :
         {glm::vec3(0.0f), view, -3.0f * view, 1e-20f * view, view + glm::vec3(1e-6f, 0, 0)}) {
        expectError(ErrorKind::invalidArgument, "up is zero or along the view", {"up"},
                    [&] { lookAt(glm::vec3(0.0f), view, up); });
    }
    EXPECT_NO_THROW(lookAt(glm::vec3(0.0f), view, view + glm::vec3(1e-3f, 0, 0)));
}

// Projects `point` to the picture: -1..1 from left to right and from top to bottom.
glm::dvec2 project(const Camera& camera, const glm::vec3 point) {
    const glm::dvec3 offset = glm::dvec3(point) - glm::dvec3(camera.eye);
    const glm::dvec3 right(camera.dirRight);
    const glm::dvec3 down(camera.dirDown);
    const double depth = glm::dot(offset, glm::dvec3(camera.forward));
    EXPECT_GT(depth, 0.0) << "behind the camera";
    return glm::dvec2(glm::dot(offset, right) / glm::dot(right, right),
                      glm::dot(offset, down) / glm::dot(down, down)) /
           depth;
}

void expectFramed(const Bounds& bounds, const float verticalFov, const glm::uvec2 size) {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const SceneCamera framed = frameBounds(bounds, verticalFov, aspect);
    EXPECT_EQ(framed.verticalFov, verticalFov);
    const Camera camera = makeCamera(framed, size.x, size.y);
    double farthest = 0.0; // from the centre of the picture
    for (unsigned i = 0; i < 8; ++i) {
        const glm::vec3 corner(i & 1u ? bounds.hi.x : bounds.lo.x, i & 2u ? bounds.hi.y : bounds.lo.y,
                               i & 4u ? bounds.hi.z : bounds.lo.z);
        const glm::dvec2 place = glm::abs(project(camera, corner));
        farthest = std::max({farthest, place.x, place.y});
    }
    EXPECT_LT(farthest, 1.0);
    EXPECT_GT(farthest, 0.5) << "too small in the picture";
}

TEST(FrameBounds, seesEveryCorner) {
    const glm::vec3 sizes[] = {{1, 1, 1}, {10, 0.1f, 1},         {0.01f, 5, 0.02f}, {1, 0, 1},
                               {0, 0, 3}, {1e-8f, 1e-8f, 2e-8f}, {1e9f, 3e8f, 5e9f}};
    const glm::uvec2 pictures[] = {{640, 480}, {480, 640}, {333, 333}, {2000, 100}, {100, 2000}};
    for (const glm::vec3 size : sizes) {
        for (const glm::vec3 lo : {glm::vec3(0.0f), -0.5f * size, 7.0f * size}) {
            for (const glm::uvec2 picture : pictures) {
                for (const float degrees : {5.0f, 45.0f, 90.0f, 150.0f}) {
                    SCOPED_TRACE(testing::Message()
                                 << size.x << " x " << size.y << " x " << size.z << " from " << lo.x << ", "
                                 << lo.y << ", " << lo.z << " in " << picture.x << "x" << picture.y
                                 << " with " << degrees << " degrees");
                    expectFramed({lo, lo + size}, degrees * kPi / 180.0f, picture);
                }
            }
        }
    }
}

TEST(FrameBounds, seesWhatIsFarFromTheOrigin) {
    const glm::vec3 lo(1e5f, -1e4f, 5e4f);
    expectFramed({lo, lo + 1.0f}, kDefaultVerticalFov, {640, 480});
}

TEST(FrameBounds, looksFromTheFrontTheRightAndAbove) {
    for (const glm::vec3 lo : {glm::vec3(0.0f), glm::vec3(1e5f, 1e5f, 1e5f)}) {
        const glm::vec3 forward = frameBounds({lo, lo + 1.0f}, 0.8f, 1.0f).forward;
        EXPECT_NEAR(forward.x, -0.45f / std::hypot(0.45f, 0.35f, 1.0f), kRounding);
        EXPECT_NEAR(forward.y, -0.35f / std::hypot(0.45f, 0.35f, 1.0f), kRounding);
    }
}

TEST(FrameBounds, takesAnEmptyBoxForTheUnitCube) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const SceneCamera empty = frameBounds({glm::vec3(kInfinity), glm::vec3(-kInfinity)}, 0.8f, 1.5f);
    const SceneCamera cube = frameBounds({glm::vec3(-0.5f), glm::vec3(0.5f)}, 0.8f, 1.5f);
    EXPECT_EQ(empty.eye, cube.eye);
    EXPECT_EQ(empty.forward, cube.forward);
}

TEST(FrameBounds, takesASinglePoint) {
    for (const glm::vec3 point : {glm::vec3(0.0f), glm::vec3(1, 2, 3), glm::vec3(-1e5f)}) {
        const SceneCamera camera = frameBounds({point, point}, 0.8f, 1.5f);
        const glm::dvec2 place = project(makeCamera(camera, 300, 200), point);
        EXPECT_NEAR(place.x, 0.0, 0.1);
        EXPECT_NEAR(place.y, 0.0, 0.1);
    }
}

// Odd numbers of pixels, so that one pixel is in the centre.
constexpr std::uint32_t kWidth = 321;
constexpr std::uint32_t kHeight = 239;
constexpr std::uint32_t kCenterX = kWidth / 2;
constexpr std::uint32_t kCenterY = kHeight / 2;

SceneCamera slanted() {
    SceneCamera camera = lookAt({1, 2, 3}, {-2, 0.5f, 1}, {0.2f, 1, 0.1f});
    camera.verticalFov = 1.1f;
    camera.verticalExtent = 5.0f;
    return camera;
}

TEST(PerspectiveCamera, looksForwardInTheCentre) {
    const SceneCamera view = slanted();
    const CameraRay ray = cameraRay(makeCamera(view, kWidth, kHeight), kCenterX, kCenterY);
    EXPECT_EQ(ray.origin, view.eye);
    EXPECT_NEAR(glm::length(ray.dir - view.forward), 0.0, kRounding);
}

TEST(PerspectiveCamera, hasItsFirstPixelTopLeft) {
    const SceneCamera view = slanted();
    const CameraRay ray = cameraRay(makeCamera(view, kWidth, kHeight), 0, 0);
    EXPECT_GT(glm::dot(ray.dir, view.up), 0.1f);
    EXPECT_LT(glm::dot(ray.dir, glm::cross(view.forward, view.up)), -0.1f);
}

TEST(PerspectiveCamera, hasTheFieldOfViewAskedFor) {
    const SceneCamera view = slanted();
    const Camera camera = makeCamera(view, kWidth, kHeight);
    const glm::vec3 right = glm::cross(view.forward, view.up);
    // Rays pass through pixel centres, so half a pixel is missing at each edge.
    const double halfHeight = std::tan(0.5 * view.verticalFov);
    const CameraRay top = cameraRay(camera, kCenterX, 0);
    EXPECT_NEAR(glm::dot(top.dir, view.up) / glm::dot(top.dir, view.forward),
                halfHeight * (1.0 - 1.0 / kHeight), kRounding);
    const CameraRay bottom = cameraRay(camera, kCenterX, kHeight - 1);
    EXPECT_NEAR(glm::dot(bottom.dir, view.up), -glm::dot(top.dir, view.up), kRounding);
    const CameraRay last = cameraRay(camera, kWidth - 1, kCenterY);
    EXPECT_NEAR(glm::dot(last.dir, right) / glm::dot(last.dir, view.forward),
                halfHeight * kWidth / kHeight * (1.0 - 1.0 / kWidth), kRounding);
}

TEST(PerspectiveCamera, hasDirectionsOfUnitLength) {
    const Camera camera = makeCamera(slanted(), kWidth, kHeight);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            ASSERT_NEAR(glm::length(cameraRay(camera, x, y).dir), 1.0, kRounding);
        }
    }
}

TEST(OrthographicCamera, hasParallelRaysOverItsExtent) {
    SceneCamera view = slanted();
    view.projection = SceneCamera::Projection::orthographic;
    const Camera camera = makeCamera(view, kWidth, kHeight);
    const glm::vec3 right = glm::cross(view.forward, view.up);
    const float pixel = view.verticalExtent / static_cast<float>(kHeight);
    for (const std::uint32_t y : {0u, kCenterY, kHeight - 1}) {
        for (const std::uint32_t x : {0u, kCenterX, kWidth - 1}) {
            const CameraRay ray = cameraRay(camera, x, y);
            EXPECT_NEAR(glm::length(ray.dir - view.forward), 0.0, kRounding);
            const float columns = static_cast<float>(x) - static_cast<float>(kCenterX);
            const float rows = static_cast<float>(y) - static_cast<float>(kCenterY);
            const glm::vec3 expected = view.eye + right * (columns * pixel) - view.up * (rows * pixel);
            EXPECT_NEAR(glm::length(ray.origin - expected), 0.0, 10.0 * kRounding);
        }
    }
}

TEST(CameraLens, refusesWhatNoLensIs) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const auto make = [](const CameraOptions& options) {
        return makeCamera(slanted(), kWidth, kHeight, options);
    };
    for (const float radius : {-1.0f, kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
        expectError(ErrorKind::invalidArgument, "an aperture's radius of ",
                    [&] { make({.apertureRadius = radius}); });
    }
    for (const float distance : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        expectError(ErrorKind::invalidArgument, "a focus distance of ",
                    [&] { make({.apertureRadius = 1.0f, .focusDistance = distance}); });
    }
    expectError(ErrorKind::invalidArgument, "a panorama is taken without a lens",
                [&] { make({.apertureRadius = 1.0f, .isPanorama = true}); });
}

} // namespace
} // namespace metamarch::tests
