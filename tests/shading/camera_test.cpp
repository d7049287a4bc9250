// SPDX-License-Identifier: MIT
// Camera rays: filters and lens against their densities, the plane in focus, the panorama's directions.
#include "chi_square.h"
#include "metamarch/shading/view.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace metamarch {
namespace {

constexpr int kDraws = 200'000;
constexpr std::size_t kCells = 64;
constexpr int kTests = 7; // number of chi-square tests in this file
constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 48;

// Returns the fraction of a filter's weight to the left of x, in pixels from the centre.
using Distribution = double (*)(double x);

double boxBelow(double x) { return std::clamp(x + 0.5, 0.0, 1.0); }

double tentBelow(double x) {
    const double inside = 1.0 - std::min(std::abs(x), 1.0);
    return x < 0.0 ? inside * inside / 2.0 : 1.0 - inside * inside / 2.0;
}

// Integrates 0.35875 + 0.48829 cos + 0.14128 cos 2 + 0.01168 cos 3 over a circle of three pixels.
double blackmanHarrisBelow(double x) {
    const double angle = 2.0 * M_PI * std::clamp(x / 3.0, -0.5, 0.5);
    const double waves = 0.48829 * std::sin(angle) + 0.14128 / 2.0 * std::sin(2.0 * angle) +
                         0.01168 / 3.0 * std::sin(3.0 * angle);
    return 0.5 + angle / (2.0 * M_PI) + waves / (2.0 * M_PI * 0.35875);
}

struct Filter {
    uint kind;
    double radius; // pixels
    Distribution below;
};

constexpr Filter kFilters[] = {{kFilterBox, 0.5, boxBelow},
                               {kFilterTent, 1.0, tentBelow},
                               {kFilterBlackmanHarris, 1.5, blackmanHarrisBelow}};

TEST(PixelFilter, drawsByItsWeightInBothAxes) {
    for (const Filter& filter : kFilters) {
        std::mt19937 random(8);
        std::uniform_real_distribution<float> even(0.0f, 0.99999994f);
        for (int axis = 0; axis < 2; ++axis) {
            Histogram histogram = evenHistogram(kCells, kDraws);
            for (int i = 0; i < kDraws; ++i) {
                const float u = even(random);
                const vec2 offset = sampleFilter(filter.kind, axis == 0 ? vec2(u, 0.5f) : vec2(0.5f, u));
                ASSERT_EQ(offset[1 - axis], 0.0f);
                const double place = (offset[axis] / filter.radius + 1.0) / 2.0;
                ASSERT_TRUE(place >= 0.0 && place <= 1.0) << offset[axis];
                histogram.observed[partOf(place, kCells)] += 1.0;
            }
            for (std::size_t cell = 0; cell < kCells; ++cell) {
                const auto edge = [&](std::size_t i) {
                    return filter.radius * (2.0 * static_cast<double>(i) / kCells - 1.0);
                };
                histogram.expected[cell] = kDraws * (filter.below(edge(cell + 1)) - filter.below(edge(cell)));
            }
            EXPECT_GT(chiSquareProbability(histogram), significanceOf(kTests)) << filter.kind;
        }
    }
}

TEST(PixelFilter, invertsItsDistribution) {
    for (const Filter& filter : kFilters) {
        for (uint bits = 0; bits < 1u << 24; bits += bits < 1000 || bits > 0xfff000 ? 1 : 997) {
            const float u = unitInterval(bits << 8);
            const float x = sampleFilter(filter.kind, vec2(u, u)).x;
            ASSERT_NEAR(filter.below(x), u, 2.5e-7) << filter.kind << " at " << u;
        }
    }
}

TEST(Lens, isADiscEvenlyFilled) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> even(0.0f, 0.99999994f);
    constexpr std::size_t kRings = 10;
    constexpr std::size_t kSectors = 24;
    Histogram histogram = evenHistogram(kRings * kSectors, kDraws);
    for (int i = 0; i < kDraws; ++i) {
        const float first = even(random);
        const vec2 point = sampleDisc(vec2(first, even(random)));
        const double square = point.x * point.x + point.y * point.y;
        ASSERT_LE(square, 1.0 + 1e-6);
        const double turn = std::atan2(point.y, point.x) / (2.0 * M_PI) + 0.5;
        const std::size_t ring = partOf(square, kRings);
        const std::size_t sector = partOf(turn, kSectors);
        histogram.observed[ring * kSectors + sector] += 1.0;
    }
    EXPECT_GT(chiSquareProbability(histogram), significanceOf(kTests));
    EXPECT_EQ(sampleDisc(vec2(0.5f, 0.5f)), vec2(0.0f));
}

SceneCamera slanted(SceneCamera::Projection projection) {
    SceneCamera camera = lookAt({1, 2, 3}, {-2, 0.5f, 1}, {0.2f, 1, 0.1f});
    camera.projection = projection;
    camera.verticalFov = 1.1f;
    camera.verticalExtent = 5.0f;
    return camera;
}

constexpr SceneCamera::Projection kProjections[] = {SceneCamera::Projection::perspective,
                                                    SceneCamera::Projection::orthographic};

// Returns where the ray crosses the plane at this distance along the view.
glm::dvec3 crossing(const Camera& camera, const CameraRay& ray, double distance) {
    const glm::dvec3 forward(camera.forward);
    const double ahead = distance - glm::dot(glm::dvec3(ray.origin) - glm::dvec3(camera.eye), forward);
    return glm::dvec3(ray.origin) + glm::dvec3(ray.dir) * (ahead / glm::dot(glm::dvec3(ray.dir), forward));
}

TEST(Lens, allItsPointsSeeOnePointOfThePlaneInFocus) {
    constexpr float kRadius = 0.25f;
    constexpr float kFocus = 3.5f;
    std::mt19937 random(10);
    std::uniform_real_distribution<float> even(0.0f, 0.99999994f);
    for (const SceneCamera::Projection projection : kProjections) {
        const SceneCamera view = slanted(projection);
        const Camera sharp = makeCamera(view, kWidth, kHeight);
        const Camera camera =
            makeCamera(view, kWidth, kHeight, {.apertureRadius = kRadius, .focusDistance = kFocus});
        for (const uint x : {0u, 20u, kWidth - 1}) {
            const CameraRay centre = cameraRay(sharp, x, 7);
            const glm::dvec3 seen = crossing(camera, centre, kFocus);
            double widest = 0.0;
            double nearer = 0.0;
            for (int i = 0; i < 1000; ++i) {
                const float uLens = even(random);
                const CameraRay ray = sampleCameraRay(camera, x, 7, vec2(0.5f), vec2(uLens, even(random)));
                ASSERT_NEAR(glm::length(crossing(camera, ray, kFocus) - seen), 0.0, 4e-6);
                ASSERT_NEAR(glm::dot(ray.origin - centre.origin, view.forward), 0.0f, 1e-6f);
                ASSERT_NEAR(glm::length(ray.dir), 1.0f, 1e-6f);
                widest = std::max(widest, double{glm::length(ray.origin - centre.origin)});
                const glm::dvec3 halfWay = crossing(camera, ray, kFocus / 2);
                nearer = std::max(nearer, glm::length(halfWay - crossing(camera, centre, kFocus / 2)));
            }
            // Rays start all over the aperture; halfway to the focus they are spread half as widely.
            EXPECT_NEAR(widest, kRadius, 0.01 * kRadius);
            EXPECT_NEAR(nearer, kRadius / 2, 0.01 * kRadius);
        }
    }
}

TEST(Lens, focusedFarAwaySendsParallelRays) {
    const Camera camera =
        makeCamera(slanted(SceneCamera::Projection::perspective), kWidth, kHeight, {.apertureRadius = 0.5f});
    EXPECT_EQ(sampleCameraRay(camera, 3, 4, vec2(0.25f), vec2(0.1f, 0.7f)).dir,
              sampleCameraRay(camera, 3, 4, vec2(0.25f), vec2(0.9f, 0.2f)).dir);
}

TEST(Pinhole, sendsThePrimaryRayThroughThePixelsCentre) {
    for (const SceneCamera::Projection projection : kProjections) {
        const Camera camera = makeCamera(slanted(projection), kWidth, kHeight);
        for (uint y = 0; y < kHeight; ++y) {
            for (uint x = 0; x < kWidth; ++x) {
                const CameraRay expected = cameraRay(camera, x, y);
                const CameraRay drawn = sampleCameraRay(camera, x, y, vec2(0.5f), vec2(0.3f, 0.8f));
                ASSERT_EQ(drawn.origin, expected.origin);
                ASSERT_EQ(drawn.dir, expected.dir);
            }
        }
    }
}

constexpr CameraOptions kPanorama = {.isPanorama = true};

// A point on the ray through a place of the picture is seen there.
TEST(PlaceOf, invertsTheRay) {
    for (const auto projection :
         {SceneCamera::Projection::perspective, SceneCamera::Projection::orthographic}) {
        for (const CameraOptions& options : {CameraOptions{}, kPanorama}) {
            const Camera camera = makeCamera(slanted(projection), kWidth, kHeight, options);
            for (const vec2 place : {vec2(0.3f, 0.6f), vec2(31.0f, 20.0f), vec2(63.0f, 47.5f)}) {
                const CameraRay ray = cameraRayThrough(camera, place, vec2(0.0f));
                const auto found = placeOf(camera, glm::dvec3(ray.origin) + 7.0 * glm::dvec3(ray.dir));
                ASSERT_TRUE(found);
                EXPECT_NEAR(found->x, place.x, 1e-4);
                EXPECT_NEAR(found->y, place.y, 1e-4);
            }
        }
    }
    const Camera pinhole = makeCamera(slanted(SceneCamera::Projection::perspective), kWidth, kHeight);
    EXPECT_FALSE(placeOf(pinhole, glm::dvec3(pinhole.eye) - glm::dvec3(pinhole.forward)));
    const Camera around =
        makeCamera(slanted(SceneCamera::Projection::perspective), kWidth, kHeight, kPanorama);
    EXPECT_FALSE(placeOf(around, glm::dvec3(around.eye)));
}

TEST(Panorama, ofAnEnvironmentIsTheEnvironment) {
    const Camera camera = makeCamera(lookAt({5, 6, 7}, {6, 6, 7}, {0, 1, 0}), kWidth, kHeight, kPanorama);
    for (uint y = 0; y < kHeight; ++y) {
        for (uint x = 0; x < kWidth; ++x) {
            const vec2 place(static_cast<float>(x) + 0.3f, static_cast<float>(y) + 0.6f);
            const CameraRay ray = cameraRayThrough(camera, place, vec2(0.7f, 0.1f));
            ASSERT_EQ(ray.origin, vec3(5, 6, 7));
            ASSERT_NEAR(glm::length(ray.dir), 1.0f, 1e-6f);
            const vec2 found = mapPoint(ray.dir) * vec2(kWidth, kHeight);
            ASSERT_NEAR(found.x, place.x, 3e-5f);
            ASSERT_NEAR(found.y, place.y, 3e-5f);
        }
    }
}

TEST(Panorama, looksForwardInTheCentreAndUpAtTheTop) {
    const SceneCamera view = slanted(SceneCamera::Projection::perspective);
    const Camera camera = makeCamera(view, kWidth, kHeight, kPanorama);
    const auto towards = [&](float x, float y) {
        return cameraRayThrough(camera, vec2(x * float{kWidth}, y * float{kHeight}), vec2(0.0f)).dir;
    };
    const vec3 right = glm::cross(view.forward, view.up);
    EXPECT_NEAR(glm::length(towards(0.5f, 0.5f) - view.forward), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(towards(0.75f, 0.5f) - right), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(towards(0.25f, 0.5f) + right), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(towards(0.0f, 0.5f) + view.forward), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(towards(0.5f, 0.0f) - view.up), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(towards(0.5f, 1.0f) + view.up), 0.0f, 1e-6f);
    // A filter reaches beyond the edges: to the opposite edge, and across the poles.
    EXPECT_NEAR(glm::length(towards(-0.01f, 0.3f) - towards(0.99f, 0.3f)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(towards(0.2f, -0.01f) - towards(0.7f, 0.01f)), 0.0f, 1e-6f);
}

} // namespace
} // namespace metamarch
