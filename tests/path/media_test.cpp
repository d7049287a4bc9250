// SPDX-License-Identifier: MIT
// Volumes within volumes: which medium the light is in (Beer and Lambert), and how it is bent and reflected
// between two of them (Snell, Fresnel).
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/path.h"
#include "metamarch/shared/media.h"
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamarch::tests {
namespace {

constexpr PathWork kWork{.samples = 256, .maxBounces = 64}; // of each of 64 pixels
// Light colours, so that Russian roulette adds little noise.
const glm::vec3 kRed(0.98f, 0.85f, 0.91f);
const glm::vec3 kGrey(0.9f, 0.93f, 0.87f);
// At most 7 surfaces from the fourth on, each survived with a probability of at least 0.75: a relative
// deviation of sqrt(7 (1 / 0.75 - 1) / (64 * 256)) = 0.012, of which 4. A medium too many or too few changes
// a channel by 9 % at least.
constexpr double kNoise = 0.048;

// The colour of white light after one unit in the medium.
Material medium(const glm::vec3 color, const float ior = 1.0f) {
    Material material = glass(ior, 0.0f);
    material.attenuationColor = color;
    material.attenuationDistance = 1.0f;
    return material;
}

// A box whose front and back are at these depths below z = 0.
void addSlab(PathScene& made, const float near, const float far, const std::uint32_t material,
             const float halfSide = 1.0f) {
    addBox(made.scene, {-halfSide, -halfSide, -far}, {halfSide, halfSide, -near}, material);
}

// A white wall far behind, so that the way to it is part of what is tested.
void addWall(PathScene& made) {
    addQuad(made.scene, {-2, -2, -20}, {4, 0, 0}, {0, 4, 0}, addMaterial(made.scene, unlit(glm::vec3(1.0f))));
}

// Looks along -z from z = `eye` at the wall.
void expectColor(PathScene made, const glm::dvec3 expected, const float eye = 3.0f) {
    addWall(made);
    const glm::dvec3 seen = probe(made, {0, 0, eye}, {0, 0, -20}, kWork);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(seen[c], expected[c], kNoise * expected[c]) << c;
    }
}

glm::dvec3 after(const glm::vec3 color, const double distance) {
    return glm::pow(glm::dvec3(color), glm::dvec3(distance));
}

// A lamp behind the surface of a volume that another one fills is seen directly: nothing has scattered its
// light, and its luminance has no limit.
TEST(Media, LampBehindAFilledSurfaceIsSeenDirectly) {
    PathScene made;
    const std::uint32_t first = addMaterial(made.scene, glass(1.5f, 0.0f));
    const std::uint32_t last = addMaterial(made.scene, glass(1.3f, 0.0f));
    addSlab(made, -5.0f, 1.0f, first);
    addSlab(made, -5.0f, 5.0f, last, 2.0f);
    addQuad(made.scene, {-1, -1, -2}, {2, 0, 0}, {0, 2, 0},
            addMaterial(made.scene, emitter(glm::vec3(7.0f))));
    made.view = lookAt({0, 0, 0}, {0, 0, -2}, {0, 1, 0});
    made.view.verticalFov = 0.2f;
    const AccelerationStructure structure = buildAccelerationStructure(made.scene, {});
    const ShadingScene shading = shadingOf(made);
    PathSettings settings = settingsOf(shading, {.clampLuminance = 1.0f});
    settings.eyeMedia = {mediumOf(last), mediumOf(first), kNoMedium, kNoMedium};
    const FilmData film = renderPathsByJudge(structure, shading, settings, makeCamera(made.view, 4, 4, {}), 2,
                                             {.parts = kFilmLight});
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        EXPECT_EQ(film.pixels[i].rays, 4u); // two of each sample
        EXPECT_EQ(film.light[i].emission, glm::vec3(14.0f));
        EXPECT_EQ(film.light[i].direct, glm::vec3(0.0f));
    }
}

TEST(Media, OuterVolumeIsBackBehindAnInnerOne) {
    PathScene made;
    addSlab(made, 0.0f, 3.0f, addMaterial(made.scene, medium(kRed)));
    addSlab(made, 1.0f, 2.0f, addMaterial(made.scene, medium(kGrey)));
    expectColor(made, after(kRed, 2.0) * after(kGrey, 1.0));
}

TEST(Media, ThreeWithinEachOther) {
    PathScene made;
    const glm::vec3 green(0.88f, 0.95f, 0.99f);
    addSlab(made, 0.0f, 5.0f, addMaterial(made.scene, medium(kRed)));
    addSlab(made, 1.0f, 4.0f, addMaterial(made.scene, medium(kGrey)));
    addSlab(made, 2.0f, 3.0f, addMaterial(made.scene, medium(green)));
    expectColor(made, after(kRed, 2.0) * after(kGrey, 2.0) * after(green, 1.0));
}

// The path leaves the volume that it entered first, first: the other one has priority where they overlap.
TEST(Media, OverlappingVolumesAreLeftInAnotherOrder) {
    PathScene made;
    addSlab(made, 0.0f, 2.0f, addMaterial(made.scene, medium(kRed, 1.5f)));
    addSlab(made, 1.0f, 3.0f, addMaterial(made.scene, medium(kGrey, 1.5f)));
    // At normal incidence light is lost at the two outer faces alone: 1.5 to 1.5 reflects nothing, up to
    // kMinVolumeIor. The paths that reflect at both are at most 0.04^2 of all.
    PathScene clear = made;
    addWall(clear);
    const double once = 0.04;
    const glm::dvec3 left = after(kRed, 1.0) * after(kGrey, 2.0);
    const glm::dvec3 seen = probe(clear, {0, 0, 3}, {0, 0, -20}, {.samples = 4096, .maxBounces = 64});
    for (int c = 0; c < 3; ++c) {
        const double passed = (1.0 - once) * (1.0 - once) * left[c] / (1.0 - once * once * left[c] * left[c]);
        EXPECT_NEAR(seen[c], passed, 4.0 * std::sqrt(passed / (64.0 * 4096.0))) << c;
    }
}

TEST(Media, OverlappingVolumesOfOneMaterialAreOneVolume) {
    PathScene made;
    const std::uint32_t material = addMaterial(made.scene, medium(kRed));
    addSlab(made, 0.0f, 2.0f, material);
    addSlab(made, 1.0f, 3.0f, material);
    expectColor(made, after(kRed, 3.0));
}

TEST(Media, VolumesThatTouch) {
    for (const bool isSwapped : {false, true}) {
        PathScene made;
        const std::uint32_t red = addMaterial(made.scene, medium(kRed));
        const std::uint32_t grey = addMaterial(made.scene, medium(kGrey));
        addSlab(made, isSwapped ? 1.0f : 0.0f, isSwapped ? 2.0f : 1.0f, red);
        addSlab(made, isSwapped ? 0.0f : 1.0f, isSwapped ? 1.0f : 2.0f, grey);
        made.surroundings.background = glm::vec3(1.0f);
        const glm::dvec3 expected = after(kRed, 1.0) * after(kGrey, 1.0);
        const glm::dvec3 seen = probe(made, {0, 0, 3}, {0, 0, -20}, kWork);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(seen[c], expected[c], kNoise * expected[c]) << isSwapped << ' ' << c;
        }
    }
}

TEST(Media, CameraIsInsideOfTwoVolumes) {
    PathScene made;
    addSlab(made, -4.0f, 5.0f, addMaterial(made.scene, medium(kRed)));
    addSlab(made, -3.5f, 1.0f, addMaterial(made.scene, medium(kGrey)), 0.5f);
    expectColor(made, after(kGrey, 4.0) * after(kRed, 4.0));
}

// More volumes than a path remembers lie beside the camera; it is in none of them.
TEST(Media, CameraIsOutsideOfManyVolumes) {
    PathScene made;
    for (int i = 0; i < 6; ++i) {
        const float grown = 0.1f * static_cast<float>(i);
        addBox(made.scene, {-30.0f - grown, 4.0f - grown, -30.0f - grown},
               {30.0f + grown, 8.0f + grown, 30.0f + grown}, addMaterial(made.scene, medium(kRed)));
    }
    expectColor(made, glm::dvec3(1.0));
}

// The camera, a white plane and a light are in one volume: the light goes 2 units to the plane, and 3 to the
// camera.
TEST(Media, LightsInAVolumeAreAbsorbed) {
    const auto seen = [](const Material& volume, const bool isPoint, const std::uint32_t strategies) {
        PathScene made;
        addBox(made.scene, {-10, -10, -10}, {10, 10, 10}, addMaterial(made.scene, volume));
        addQuad(made.scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0},
                addMaterial(made.scene, lambert(glm::vec3(1.0f))));
        if (isPoint) {
            addPointLight(made.scene, {0, 0, 2}, 10.0f);
        } else {
            addQuad(made.scene, {-0.1f, -0.1f, 2}, {0, 0.2f, 0}, {0.2f, 0, 0},
                    addMaterial(made.scene, emitter(glm::vec3(100.0f))));
        }
        return probe(made, {0.5f, 0, 3}, {0, 0, 0},
                     {.samples = isPoint ? 4u : 1024u, .maxBounces = 0, .strategies = strategies});
    };
    const Material clear = glass(1.0f, 0.0f);
    const glm::dvec3 expected = after(kRed, 2.0 + std::sqrt(9.25));
    const glm::dvec3 ofPoint = seen(medium(kRed), true, kSampleLights) / seen(clear, true, kSampleLights);
    const glm::dvec3 ofLights = seen(medium(kRed), false, kSampleLights) / seen(clear, false, kSampleLights);
    const glm::dvec3 ofBsdf = seen(medium(kRed), false, kSampleBsdf) / seen(clear, false, kSampleBsdf);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(ofPoint[c], expected[c], 1e-4) << c;
        // The lamp is 0.2 wide: its corners are 0.5 % farther.
        EXPECT_NEAR(ofLights[c], expected[c], 0.005) << c;
        // Every clear sample has its absorbed one: the noise is in the distance alone.
        EXPECT_NEAR(ofBsdf[c], expected[c], 0.005) << c;
    }
}

// Light at normal incidence: a bubble of air in glass reflects as glass does in air, and water in glass less.
TEST(Media, IndicesBetweenVolumesAreRelative) {
    const auto reflected = [](const float outer, const float inner) {
        PathScene made;
        // The camera is inside the outer volume. The far face of the inner one is behind a black wall.
        addBox(made.scene, {-40, -40, -40}, {40, 40, 40}, addMaterial(made.scene, glass(outer, 0.0f)));
        addBox(made.scene, {-20, -20, -20}, {20, 20, 0}, addMaterial(made.scene, glass(inner, 0.0f)));
        const std::uint32_t white = addMaterial(made.scene, unlit(glm::vec3(1.0f)));
        addQuad(made.scene, {-10, -10, 30}, {20, 0, 0}, {0, 20, 0}, white);
        const std::uint32_t black = addMaterial(made.scene, unlit(glm::vec3(0.0f)));
        addQuad(made.scene, {-19, -19, -10}, {38, 0, 0}, {0, 38, 0}, black);
        return probe(made, {0.01f, 0, 3}, {0, 0, 0}, {.samples = 4096, .maxBounces = 8}).r;
    };
    const auto part = [](const double eta) { return std::pow((eta - 1.0) / (eta + 1.0), 2.0); };
    const auto noise = [](const double p) { return 4.0 * std::sqrt(p / (64.0 * 4096.0)); };
    EXPECT_NEAR(reflected(1.5f, 1.0f), part(1.5), noise(part(1.5)));
    const double waterInGlass = part(1.5 / 1.33);
    EXPECT_NEAR(reflected(1.5f, 1.33f), waterInGlass, noise(waterInGlass));
    EXPECT_NEAR(reflected(1.33f, 1.5f), waterInGlass, noise(waterInGlass));
    EXPECT_NEAR(reflected(1.5f, 1.5f), 0.0, 2e-5); // 2.5e-7, by kMinVolumeIor
}

// The radiance in a volume is that outside, times the square of its index, and is the same again behind it.
TEST(Media, RadianceIsTheSameBehindAllVolumes) {
    PathScene made;
    addSlab(made, 0.0f, 4.0f, addMaterial(made.scene, glass(1.5f, 0.0f)));
    addSlab(made, 1.0f, 5.0f, addMaterial(made.scene, glass(1.33f, 0.0f)));
    addSlab(made, 2.0f, 3.0f, addMaterial(made.scene, glass(1.0f, 0.0f)));
    made.surroundings.background = glm::vec3(1.0f);
    EXPECT_NEAR(probe(made, {0, 0, 3}, {0, 0, 0}, {.samples = 256, .maxBounces = 64}).g, 1.0, 1e-4);
}

TEST(Media, ListKeepsTheOrderAndTheLimit) {
    Media media = noMedia();
    for (const std::uint32_t material : {1u, 2u, 3u, 4u, 5u}) {
        media = enterMedium(media, material);
    }
    EXPECT_FALSE(isInside(media, 1)) << "the one entered first is forgotten";
    media = leaveMedium(media, 3);
    EXPECT_EQ(media.first, 5u);
    EXPECT_EQ(media.second, 4u);
    EXPECT_EQ(media.third, 2u);
    EXPECT_EQ(media.fourth, kNoMedium);
    media = enclosedBy(media, 7);
    EXPECT_EQ(media.fourth, 7u);
    const Media unchanged = leaveMedium(media, 9);
    EXPECT_EQ(unchanged.first, 5u);
    EXPECT_EQ(unchanged.fourth, 7u);
    EXPECT_TRUE(isInterface(media, 9, false));
    EXPECT_FALSE(isInterface(media, 5, false));
    EXPECT_TRUE(isInterface(media, 5, true));
    EXPECT_FALSE(isInterface(media, 4, true));
}

} // namespace
} // namespace metamarch::tests
