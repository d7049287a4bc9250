// SPDX-License-Identifier: MIT
// Compares direct light on a Lambert reflector with closed forms.
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace metamarch::tests {
namespace {

constexpr float kAlbedo = 0.7f;
constexpr double kInverse = kAlbedo / std::numbers::pi;

// Returns a floor at y = 0 without lights.
PathScene floorScene() {
    PathScene made;
    addQuad(made.scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10},
            addMaterial(made.scene, lambert(glm::vec3(kAlbedo))));
    return made;
}

// Returns the radiance of the floor at (x, 0, z), seen from the side.
double floorAt(const PathScene& made, const float x, const float z, const PathWork& work = {}) {
    return probe(made, {x + 2.0f, 0.5f, z + 0.7f}, {x, 0.0f, z}, work).g;
}

// Only the place in a pixel, 3e-5 units wide, is random, so the tolerance is for rounding only.
TEST(PathLight, pointLightFallsWithSquareAndCosine) {
    for (const float height : {0.5f, 2.0f}) {
        PathScene made = floorScene();
        addPointLight(made.scene, {0, height, 0}, 3.0f);
        for (const float x : {0.0f, 0.5f, 2.0f}) {
            const double distance = std::hypot(height, x);
            const double expected = kInverse * 3.0 * height / std::pow(distance, 3.0);
            EXPECT_NEAR(floorAt(made, x, 0.0f), expected, 2e-4 * expected) << height << " " << x;
        }
    }
}

TEST(PathLight, directionalLightFallsWithTheCosine) {
    for (const float angle : {0.0f, 0.5f, 1.4f}) {
        PathScene made = floorScene();
        PunctualLight light;
        light.type = PunctualLight::Type::directional;
        light.intensity = 2.0f;
        light.direction = {std::sin(angle), -std::cos(angle), 0.0f};
        made.scene.lights.push_back(light);
        const double expected = kInverse * 2.0 * std::cos(angle);
        EXPECT_NEAR(floorAt(made, 0.3f, 0.2f), expected, 2e-4 * expected) << angle;
    }
}

// Points and spots of a tree of lights add up. One spot shines on the floor at a flat angle to its axis, and
// a bright point is hidden by a plate.
TEST(PathLight, treeOfPointsAndSpotsAddsUp) {
    PathScene made = floorScene();
    double expected = 0.0;
    const auto add = [&](const glm::vec3 position, const float candela) {
        const double distance = glm::length(position);
        expected += kInverse * candela * position.y / std::pow(distance, 3.0);
        addPointLight(made.scene, position, candela);
    };
    add({0, 1, 0}, 1.0f);
    add({1, 2, 0.5f}, 3.0f);
    add({-2, 0.5f, 1}, 20.0f);
    add({-2.1f, 0.5f, 1}, 10.0f);
    PunctualLight spot;
    spot.type = PunctualLight::Type::spot;
    spot.position = {1, 1, -1};
    spot.direction = glm::normalize(glm::vec3(1, 0.1f, 0)); // 1.2 radians away from the floor's point
    spot.intensity = 8.0f;
    spot.innerConeAngle = 2.3f;
    spot.outerConeAngle = 2.4f;
    made.scene.lights.push_back(spot);
    expected += kInverse * 8.0 / std::pow(3.0, 1.5);
    addPointLight(made.scene, {0.3f, 3, 0}, 100.0f);
    addQuad(made.scene, {0.1f, 2.5f, 0.2f}, {0.4f, 0, 0}, {0, 0, -0.4f},
            addMaterial(made.scene, lambert(glm::vec3(0))));
    EXPECT_NEAR(floorAt(made, 0.0f, 0.0f, {.samples = 1024, .maxBounces = 0}), expected, 0.015 * expected);
}

// By KHR_lights_punctual, the falloff is the square of (cos - cos outer) / (cos inner - cos outer).
TEST(PathLight, spotFadesBetweenItsCones) {
    PathScene made = floorScene();
    PunctualLight light;
    light.type = PunctualLight::Type::spot;
    light.position = {0, 2, 0};
    light.direction = {0, -1, 0};
    light.intensity = 5.0f;
    light.innerConeAngle = 0.3f;
    light.outerConeAngle = 0.6f;
    made.scene.lights.push_back(light);
    for (const double angle : {0.0, 0.29, 0.35, 0.5, 0.59, 0.61, 0.9}) {
        const double fade =
            std::clamp((std::cos(angle) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6)), 0.0, 1.0);
        const double expected = kInverse * 5.0 * std::pow(std::cos(angle), 3.0) / 4.0 * fade * fade;
        const float x = static_cast<float>(2.0 * std::tan(angle));
        EXPECT_NEAR(floorAt(made, x, 0.0f), expected, 2e-4 * expected + 1e-5) << angle;
    }
}

// The irradiance of the sun is its radiance times its solid angle, whether light sampling or rays find it.
TEST(PathLight, discIsARadianceOfItsSize) {
    PathScene made = floorScene();
    LightRecord sun{};
    sun.kind = kLightDisc;
    sun.direction = glm::normalize(glm::vec3(0.5f, 1.0f, 0.0f));
    sun.scale = 0.02f;
    sun.strength = glm::vec3(8.0f);
    made.surroundings.sun = sun;
    // The mean of the direction over a cone is its axis times 1 - size / 2.
    const double expected = kInverse * 8.0 * 2.0 * std::numbers::pi * 0.02 * 0.99 * sun.direction.y;
    for (const std::uint32_t strategies : {kSampleLights | kSampleBsdf, kSampleLights, kSampleBsdf}) {
        const PathWork work{
            .samples = strategies == kSampleBsdf ? 8192u : 1024u, .maxBounces = 0, .strategies = strategies};
        EXPECT_NEAR(floorAt(made, 0, 0, work), expected, 0.005 * expected) << strategies;
    }
    const glm::dvec3 seen = probe(made, {0, 1, 0}, glm::vec3(0, 1, 0) + sun.direction, {.samples = 4});
    EXPECT_EQ(seen.r, 8.0);
}

// Returns the irradiance divided by pi at `point` of the floor, from a horizontal rectangle (x0, x1, z0, z1)
// at height y that emits downwards.
double formFactor(const glm::dvec2 point, const double y, const glm::dvec4 rectangle,
                  const std::function<double(double u, double v)>& radiance) {
    constexpr int kSteps = 500;
    const glm::dvec2 size(rectangle.y - rectangle.x, rectangle.w - rectangle.z);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const double u = (i + 0.5) / kSteps;
            const double v = (j + 0.5) / kSteps;
            const double dx = rectangle.x + u * size.x - point.x;
            const double dz = rectangle.z + v * size.y - point.y;
            const double square = dx * dx + y * y + dz * dz;
            sum += radiance(u, v) * y * y / (square * square);
        }
    }
    return sum * size.x * size.y / (kSteps * kSteps) / std::numbers::pi;
}

// Returns a floor under a quad: x and z go from -0.5 to 0.5, the height is 0.8; u grows with x, v with z.
PathScene underAQuad(const Material& light) {
    PathScene made = floorScene();
    addQuad(made.scene, {-0.5f, 0.8f, -0.5f}, {1, 0, 0}, {0, 0, 1}, addMaterial(made.scene, light));
    return made;
}

// `peak` is the largest radiance.
void expectFormFactors(const PathScene& made, const double peak,
                       const std::function<double(double u, double v)>& radiance) {
    constexpr double kSamples = 64.0 * 1024.0; // number of samples of a probe
    for (const float x : {0.0f, 0.4f, 1.5f}) {
        const double expected = kAlbedo * formFactor({x, 0.2}, 0.8, {-0.5, 0.5, -0.5, 0.5}, radiance);
        for (const std::uint32_t strategies : {kSampleLights | kSampleBsdf, kSampleLights, kSampleBsdf}) {
            const PathWork work{.samples = 1024, .maxBounces = 0, .strategies = strategies};
            // A sample of the BSDF finds the light or not; the tolerance is four times the largest standard
            // error.
            const double noise = 4.0 * std::sqrt(expected * kAlbedo * peak / kSamples);
            const double tolerance = strategies == kSampleBsdf ? noise : 0.01 * expected;
            EXPECT_NEAR(floorAt(made, x, 0.2f, work), expected, tolerance) << x << " " << strategies;
        }
    }
}

// Lambert's form factor of a parallel rectangle, under its centre.
TEST(PathLight, squareOverTheFloor) {
    const double side = 0.5 / 0.8;
    const double root = std::sqrt(1.0 + side * side);
    const double corner = side / root * std::atan(side / root) / std::numbers::pi;
    const double expected = 4.0 * corner;
    EXPECT_NEAR(formFactor({0, 0}, 0.8, {-0.5, 0.5, -0.5, 0.5}, [](double, double) { return 1.0; }), expected,
                1e-5);
    const PathScene made = underAQuad(emitter(glm::vec3(2.0f)));
    EXPECT_NEAR(floorAt(made, 0, 0, {.samples = 4096, .maxBounces = 0}), 2.0 * kAlbedo * expected,
                0.004 * expected);
    expectFormFactors(made, 2.0, [](double, double) { return 2.0; });
}

TEST(PathLight, texturedSquareOverTheFloor) {
    Material light = emitter(glm::vec3(3.0f));
    PathScene made = underAQuad(light);
    const glm::u8vec4 bright(255);
    const glm::u8vec4 dark(51); // a fifth
    light.emissiveTexture.texture =
        addTexture(made.scene, 2, {bright, dark, dark, glm::u8vec4(0)}, TextureFilter::nearest);
    made.scene.materials.back() = light;
    expectFormFactors(made, 3.0, [](const double u, const double v) {
        return u < 0.5 && v < 0.5 ? 3.0 : u > 0.5 && v > 0.5 ? 0.0 : 0.6;
    });
}

TEST(PathLight, quadShinesToItsFrontAlone) {
    PathScene made = underAQuad(emitter(glm::vec3(2.0f)));
    const auto above = [&] { return probe(made, {0.1f, 2.0f, 0.1f}, {0.0f, 0.8f, 0.0f}, {}).r; };
    EXPECT_EQ(above(), 0.0);
    made.scene.materials.back().doubleSided = true;
    EXPECT_EQ(above(), 2.0);
}

// From a convex body only the sky is visible.
TEST(PathLight, skyAlone) {
    PathScene made = floorScene();
    made.surroundings.background = {1.0f, 2.0f, 0.5f};
    EXPECT_NEAR(floorAt(made, 0, 0), 2.0 * kAlbedo, 1e-5);
    made.surroundings.background = glm::vec3(0.0f);
    made.surroundings.environment = upperHalf(64);
    for (const std::uint32_t strategies : {kSampleLights | kSampleBsdf, kSampleLights, kSampleBsdf}) {
        // One of the 64 rows blends across the horizon: it adds half of its light below, at cosines under
        // 0.05.
        EXPECT_NEAR(floorAt(made, 0, 0, {.samples = 1024, .strategies = strategies}), kAlbedo, 0.003)
            << strategies;
    }
}

TEST(PathLight, unlitIsItsColour) {
    PathScene made = floorScene();
    addPointLight(made.scene, {0, 1, 0}, 100.0f);
    made.surroundings.background = glm::vec3(5.0f);
    made.scene.materials.front() = unlit({0.25f, 0.5f, 0.75f});
    EXPECT_EQ(probe(made, {1, 1, 1}, {0, 0, 0}, {.samples = 4}), glm::dvec3(0.25, 0.5, 0.75));
}

} // namespace
} // namespace metamarch::tests
