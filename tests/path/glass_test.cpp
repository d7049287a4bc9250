// SPDX-License-Identifier: MIT
// Smooth glass: the direction of light (Snell), its reflection (Fresnel) and its absorption (Beer and
// Lambert).
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace metamarch::tests {
namespace {

constexpr float kIor = 1.5f;
constexpr PathWork kWork{.samples = 256, .maxBounces = 64};

// Returns the reflectance for unpolarized light that arrives in air.
double fresnel(const double angle, const double ior) {
    const double inside = std::asin(std::sin(angle) / ior);
    const double s = (std::cos(angle) - ior * std::cos(inside)) / (std::cos(angle) + ior * std::cos(inside));
    const double p = (ior * std::cos(angle) - std::cos(inside)) / (ior * std::cos(angle) + std::cos(inside));
    return 0.5 * (s * s + p * p);
}

// Returns a slab from z = 0 to z = -thickness. Its sides are outside of the views.
PathScene slab(const Material& material, const float thickness, const float halfSide = 50.0f) {
    PathScene made;
    addBox(made.scene, {-halfSide, -halfSide, -thickness}, {halfSide, halfSide, 0},
           addMaterial(made.scene, material));
    return made;
}

// The smooth dielectric of glTF uses Schlick's approximation, which is exact at normal incidence.
TEST(PathGlass, blackDielectricReflectsFresnelsPart) {
    for (const float ior : {1.1f, 1.33f, 1.5f, 2.4f}) {
        PathScene made;
        Material black;
        black.baseColorFactor = {0, 0, 0, 1};
        black.metallicFactor = 0.0f;
        black.roughnessFactor = 0.0f;
        black.ior = ior;
        addQuad(made.scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, addMaterial(made.scene, black));
        made.surroundings.environment = upperHalf(16);
        const double expected = std::pow((ior - 1.0) / (ior + 1.0), 2.0);
        EXPECT_NEAR(probe(made, {0, 3, 0}, {0, 0, 0}, {}).r, expected, 1e-5) << ior;
    }
}

// Both faces of a slab reflect, and light goes to and fro between them: 2F / (1 + F).
TEST(PathGlass, slabReflectsFromBothFaces) {
    PathScene made;
    addBox(made.scene, {-50, -1, -50}, {50, 0, 50}, addMaterial(made.scene, glass(kIor, 0.0f)));
    made.surroundings.environment = upperHalf(16);
    const double once = fresnel(0.0, kIor);
    // A sample is reflected or not. The tolerance is four standard errors, which are sqrt(p (1 - p) /
    // samples) each.
    const double p = 2.0 * once / (1.0 + once);
    EXPECT_NEAR(probe(made, {0, 3, 0}, {0, 0, 0}, {.samples = 4096, .maxBounces = 64}).r, p,
                4.0 * std::sqrt(p / (64.0 * 4096.0)));
}

// Between equal media nothing is reflected, up to kMinVolumeIor = 1.001; only the attenuation remains. Rays
// start above their triangle by 1.6e-6 of its edge (kTestError); this part of the way is not attenuated.
TEST(PathGlass, tintedSlabWithoutRefraction) {
    Material tinted = glass(1.0f, 0.0f);
    tinted.attenuationColor = {0.9f, 0.5f, 0.1f};
    tinted.attenuationDistance = 2.0f;
    for (const float thickness : {0.5f, 2.0f, 3.0f}) {
        PathScene made = slab(tinted, thickness, 1.0f);
        // Behind the slab there is no attenuation.
        addQuad(made.scene, {-1, -1, -thickness - 5.0f}, {2, 0, 0}, {0, 2, 0},
                addMaterial(made.scene, unlit(glm::vec3(1.0f))));
        const glm::dvec3 seen = probe(made, {0, 0, 3}, {0, 0, 0}, kWork);
        const glm::dvec3 expected =
            glm::pow(glm::dvec3(tinted.attenuationColor), glm::dvec3(thickness / 2.0));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(seen[c], expected[c], 1e-5) << thickness << " " << c;
        }
    }
}

// With refraction, light is attenuated along the refracted way each time that it crosses the slab.
TEST(PathGlass, tintedSlabAtEveryAngle) {
    Material tinted = glass(kIor, 0.0f);
    tinted.attenuationColor = {0.9f, 0.5f, 0.1f};
    PathScene made = slab(tinted, 1.0f);
    tinted.attenuationDistance = 1.0f;
    made.scene.materials.front() = tinted;
    made.surroundings.background = glm::vec3(1.0f);
    for (const double angle : {0.0, 0.6, 1.2}) {
        const double once = fresnel(angle, kIor);
        const double way = 1.0 / std::cos(std::asin(std::sin(angle) / kIor));
        const glm::vec3 eye(3.0f * static_cast<float>(std::sin(angle)), 0.0f,
                            3.0f * static_cast<float>(std::cos(angle)));
        const glm::dvec3 seen = probe(made, eye, {0, 0, 0}, {.samples = 4096, .maxBounces = 64});
        for (int c = 0; c < 3; ++c) {
            const double left = std::pow(static_cast<double>(tinted.attenuationColor[c]), way);
            const double passed = (1.0 - once) * (1.0 - once) * left / (1.0 - once * once * left * left);
            const double reflected = once * (1.0 + left * passed);
            // Samples are between 0 and 1, so the standard error is below 0.5 / 512.
            EXPECT_NEAR(seen[c], reflected + passed, 0.003) << angle << " " << c;
        }
    }
}

// A ray through glass meets a screen at the place `edge`. The screen is red on one side of an edge and green
// on the other. The view is rendered with the edge a little after and a little before that place; these are
// the reds.
struct EdgeView {
    double before; // the edge is after the place
    double after;
};

EdgeView lookAtEdge(PathScene made, const glm::vec3 eye, const glm::vec3 target, const glm::vec3 edge,
                    const glm::vec3 across, const glm::vec3 along) {
    constexpr float kGap = 2e-3f; // the view is 1e-4 radians wide
    const std::uint32_t red = addMaterial(made.scene, unlit({1, 0, 0}));
    const std::uint32_t green = addMaterial(made.scene, unlit({0, 1, 0}));
    const auto redWithEdgeAt = [&](const glm::vec3 place) {
        PathScene seen = made;
        addQuad(seen.scene, place - 0.5f * along, -0.5f * across, along, red);
        addQuad(seen.scene, place - 0.5f * along, 0.5f * across, along, green);
        return probe(seen, eye, target, kWork).r;
    };
    return {redWithEdgeAt(edge + kGap * across), redWithEdgeAt(edge - kGap * across)};
}

TEST(PathGlass, slabDisplacesARayBySnellsLaw) {
    for (const double angle : {0.3, 0.9, 1.3}) {
        const double inside = std::asin(std::sin(angle) / kIor);
        const glm::vec3 eye(-3.0f * static_cast<float>(std::sin(angle)), 0.0f,
                            3.0f * static_cast<float>(std::cos(angle)));
        const glm::vec3 edge(std::tan(inside) + 0.5 * std::tan(angle), 0.0, -1.5);
        const double once = fresnel(angle, kIor);
        // Light that is reflected twice inside leaves the slab further along, on the green side.
        const EdgeView seen =
            lookAtEdge(slab(glass(kIor, 0.0f), 1.0f), eye, {0, 0, 0}, edge, {1, 0, 0}, {0, 1, 0});
        const double passed = (1.0 - once) * (1.0 - once);
        EXPECT_NEAR(seen.before, passed, 4.0 * std::sqrt(passed * (1.0 - passed) / (64.0 * kWork.samples)))
            << angle;
        EXPECT_EQ(seen.after, 0.0) << angle;
    }
}

// At minimum deviation, light goes parallel to the base of the prism. The deviation is 2 asin(n sin(A / 2)) -
// A.
TEST(PathGlass, prismDeviatesARayBySnellsLaw) {
    constexpr double kApex = std::numbers::pi / 3.0;
    const double root = std::sqrt(3.0);
    PathScene made;
    const std::uint32_t material = addMaterial(made.scene, glass(kIor, 0.0f));
    const glm::vec3 apex(0, root, 0);
    const glm::vec3 depth(0, 0, 20);
    const glm::vec3 inside(0.0f, 0.5f, 0.0f);
    const glm::vec3 corners[] = {{-1, 0, 0}, {1, 0, 0}, apex};
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 a = corners[i];
        const glm::vec3 b = corners[(i + 1) % 3];
        addFacet(made.scene, a - depth, b - depth, b + depth, inside, material);
        addFacet(made.scene, a - depth, b + depth, a + depth, inside, material);
    }
    addFacet(made.scene, corners[0] - depth, corners[1] - depth, apex - depth, inside, material);
    addFacet(made.scene, corners[0] + depth, corners[1] + depth, apex + depth, inside, material);

    const double deviation = 2.0 * std::asin(kIor * std::sin(0.5 * kApex)) - kApex;
    constexpr double kHeight = 0.8;
    const double half = 1.0 - kHeight / root; // half of the prism's width at that height
    const glm::dvec3 along(std::cos(0.5 * deviation), std::sin(0.5 * deviation), 0.0);
    const glm::dvec3 entry(-half, kHeight, 0.0);
    const glm::dvec3 edge(3.0, kHeight - (3.0 - half) * std::tan(0.5 * deviation), 0.0);
    const EdgeView seen = lookAtEdge(made, glm::vec3(entry - 3.0 * along), glm::vec3(entry), glm::vec3(edge),
                                     {0, -1, 0}, {0, 0, 1});
    const double once = fresnel(0.5 * (deviation + kApex), kIor);
    const double passed = (1.0 - once) * (1.0 - once);
    EXPECT_NEAR(seen.before, passed, 4.0 * std::sqrt(passed * (1.0 - passed) / (64.0 * kWork.samples)));
    // One ten-thousandth comes from light that is reflected on all three sides and leaves in the same
    // direction.
    EXPECT_LT(seen.after, 0.001);
}

// Light samples go straight through smooth, thin glass. A pane lets 1 - F of the light through, with
// Schlick's F for the index 1.5.
constexpr double kFloorAlbedo = 0.5;

Material pane(const glm::vec3 color, const float roughness) {
    Material made = glass(kIor, roughness);
    made.thicknessFactor = 0.0f;
    made.baseColorFactor = glm::vec4(color, 1.0f);
    return made;
}

PathScene floorUnder(const std::vector<Material>& panes) {
    PathScene made;
    addQuad(made.scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40},
            addMaterial(made.scene, lambert(glm::vec3(float{kFloorAlbedo}))));
    float height = 1.0f;
    for (const Material& material : panes) {
        addQuad(made.scene, {-20, height, 20}, {40, 0, 0}, {0, 0, -40}, addMaterial(made.scene, material));
        height += 0.1f;
    }
    return made;
}

// The direct light that the floor reflects at the origin, seen from below the panes.
glm::dvec3 directLight(const PathScene& made, const std::uint32_t samples, const std::uint32_t strategies) {
    return probe(made, {0.6f, 0.5f, 0.0f}, {0, 0, 0},
                 {.samples = samples, .maxBounces = 0, .strategies = strategies});
}

TEST(PathPanes, letPointLightThrough) {
    const Material red = pane({0.9f, 0.3f, 0.2f}, 0.0f);
    const Material clear = pane(glm::vec3(1.0f), 0.0f);
    for (const double angle : {0.0, 0.5, 1.0, 1.3}) {
        PathScene made = floorUnder({red, clear});
        addPointLight(made.scene, {3.0f * static_cast<float>(std::tan(angle)), 3.0f, 0.0f}, 10.0f);
        const double passed = 0.96 * (1.0 - std::pow(1.0 - std::cos(angle), 5.0));
        const double irradiance = 10.0 / 9.0 * std::pow(std::cos(angle), 3.0);
        const double whole = kFloorAlbedo / std::numbers::pi * irradiance * passed * passed;
        const glm::dvec3 found = directLight(made, 4, kSampleLights | kSampleBsdf);
        const glm::dvec3 expected = whole * glm::dvec3(0.9, 0.3, 0.2);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], expected[c], 1e-4 * expected[c]) << angle << " " << c;
        }
    }
}

TEST(PathPanes, hideLightIfRoughOrThick) {
    for (const Material& material : {pane(glm::vec3(1.0f), 0.3f), glass(kIor, 0.0f)}) {
        PathScene made = floorUnder({material});
        addPointLight(made.scene, {0, 3, 0}, 10.0f);
        EXPECT_EQ(directLight(made, 4, kSampleLights | kSampleBsdf).r, 0.0);
    }
}

// The lamp is so high above the floor that its light is all but normal to the panes.
TEST(PathPanes, letLampThroughByEveryStrategy) {
    const auto lit = [](const std::vector<Material>& panes, const std::uint32_t strategies) {
        PathScene made = floorUnder(panes);
        addQuad(made.scene, {-0.5f, 3, -0.5f}, {1, 0, 0}, {0, 0, 1},
                addMaterial(made.scene, emitter(glm::vec3(9.0f))));
        return directLight(made, strategies == kSampleBsdf ? 8192 : 256, strategies).g;
    };
    const Material green = pane({0.1f, 0.7f, 0.2f}, 0.0f);
    const double expected = 0.96 * 0.96 * 0.7 * 0.7 * lit({}, kSampleLights);
    EXPECT_NEAR(lit({green, green}, kSampleLights), expected, 0.003 * expected);
    EXPECT_NEAR(lit({green, green}, kSampleLights | kSampleBsdf), expected, 0.006 * expected);
    EXPECT_NEAR(lit({green, green}, kSampleBsdf), expected, 0.03 * expected);
}

} // namespace
} // namespace metamarch::tests
