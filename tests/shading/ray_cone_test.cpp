// SPDX-License-Identifier: MIT
// Ray cones: the pixels of a camera share its view among them, and surfaces pass cones on.
#include "metamarch/shading/view.h"
#include "metamarch/shared/path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamarch {
namespace {

constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 48;

Camera cameraOf(const SceneCamera& view, const CameraOptions& options = {}) {
    return makeCamera(view, kWidth, kHeight, options);
}

RayCone coneOf(const Camera& camera, const float x, const float y) {
    return cameraCone(camera, cameraRayThrough(camera, {x, y}, {0.0f, 0.0f}).dir);
}

// Returns the total solid angle of all pixels' cones; each has the square of its spread.
double solidAngleOf(const Camera& camera) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
        const auto row = i / kWidth;
        const RayCone cone =
            coneOf(camera, static_cast<float>(i % kWidth) + 0.5f, static_cast<float>(row) + 0.5f);
        EXPECT_EQ(cone.width, 0.0f);
        sum += double{cone.spread} * cone.spread;
    }
    return sum;
}

TEST(RayCone, isAsWideAsAPixelAtADistance) {
    SceneCamera view = lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    view.verticalFov = 0.8f;
    const RayCone cone = coneOf(cameraOf(view), kWidth / 2.0f, kHeight / 2.0f);
    EXPECT_NEAR(widthAt(cone, 5.0f), 2.0 * 5.0 * std::tan(0.4) / kHeight, 1e-6);
    EXPECT_NEAR(widthAt(cone, 10.0f), 2.0 * 10.0 * std::tan(0.4) / kHeight, 1e-6);
}

// A pyramid with half-angles a and b, the angles of its side faces, has the solid angle 4 asin(sin a sin b).
TEST(RayCone, pixelsOfAWidePictureFillItsSolidAngle) {
    SceneCamera view = lookAt({1, 2, 3}, {4, 4, 4}, {0, 1, 0});
    view.verticalFov = 2.2f;
    const double down = std::tan(1.1);
    const double right = down * kWidth / kHeight;
    const double exact = 4.0 * std::atan(right * down / std::sqrt(1.0 + right * right + down * down));
    EXPECT_NEAR(solidAngleOf(cameraOf(view)), exact, 1e-3 * exact);
}

TEST(RayCone, pixelsOfAPanoramaFillTheSphere) {
    const SceneCamera view = lookAt({1, 2, 3}, {4, 4, 4}, {0, 1, 0});
    const double exact = 4.0 * M_PI;
    EXPECT_NEAR(solidAngleOf(cameraOf(view, {.isPanorama = true})), exact, 1e-3 * exact);
}

TEST(RayCone, isParallelForAnOrthographicCamera) {
    SceneCamera view = lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    view.projection = SceneCamera::Projection::orthographic;
    view.verticalExtent = 3.0f;
    const RayCone cone = coneOf(cameraOf(view), 3.0f, 40.0f);
    EXPECT_NEAR(cone.width, 3.0 / kHeight, 1e-6);
    EXPECT_EQ(cone.spread, 0.0f);
    EXPECT_EQ(widthAt(cone, 100.0f), cone.width);
}

TEST(RayCone, isNotWidenedByALens) {
    SceneCamera view = lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    const Camera pinhole = cameraOf(view);
    const Camera lens = cameraOf(view, {.apertureRadius = 0.3f, .focusDistance = 4.0f});
    EXPECT_EQ(coneOf(lens, 20.0f, 10.0f).spread, coneOf(pinhole, 20.0f, 10.0f).spread);
}

TEST(RayCone, goesOnFromMirrorsAndWidensWhereLightScatters) {
    const RayCone cone{0.0f, 0.01f};
    const float width = widthAt(cone, 3.0f);
    const RayCone mirrored = scatteredCone(cone, width, kCertain);
    EXPECT_FLOAT_EQ(widthAt(mirrored, 2.0f), widthAt(cone, 5.0f));
    const RayCone diffuse = scatteredCone(cone, width, kInvPi);
    const RayCone glossy = scatteredCone(cone, width, 50.0f);
    EXPECT_EQ(diffuse.width, width);
    EXPECT_GT(glossy.spread, cone.spread);
    EXPECT_NEAR(double{diffuse.spread} * diffuse.spread, 0.0001 + double{kScatteredPart} * M_PI, 1e-5);
}

TEST(RayCone, cutsAnAreaOutOfATriangle) {
    const TriangleRecord triangle{{0, 0, 0}, 0, {4, 0, 0}, 0, {0, 3, 0}, 0};
    const vec3 straight(0.0f, 0.0f, -1.0f);
    EXPECT_FLOAT_EQ(seenPart(triangle, straight, 0.5f, 0), 0.25f / 12.0f);
    EXPECT_FLOAT_EQ(seenPart(triangle, -straight, 0.5f, 0), 0.25f / 12.0f);
    // If the ray is oblique, the part grows by 1 / cosine. Its side falls with the power 3/4 of the number of
    // samples.
    EXPECT_FLOAT_EQ(seenPart(triangle, vec3(0.8f, 0.0f, -0.6f), 0.5f, 0), 0.25f / 12.0f / 0.6f);
    EXPECT_FLOAT_EQ(seenPart(triangle, straight, 0.5f, 3), 0.25f / 12.0f / 8.0f);
}

} // namespace
} // namespace metamarch
