// SPDX-License-Identifier: MIT
// Samples that are not finite are counted, but they are in no sum.
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace metamarch::tests {
namespace {

void expectFinite(const std::vector<FilmPixel>& film, const std::uint32_t samples) {
    for (const FilmPixel& pixel : film) {
        ASSERT_EQ(pixel.samples, samples);
        ASSERT_LE(pixel.rejected, samples);
        const FirstHit& seen = pixel.seen;
        for (const glm::vec3& sum : {pixel.radiance, pixel.squares, seen.albedo, seen.normal,
                                     seen.shadingNormal, glm::vec3(seen.depth, seen.t, pixel.covered)}) {
            for (int c = 0; c < 3; ++c) {
                ASSERT_TRUE(std::isfinite(sum[c]));
            }
        }
    }
}

PathScene floorUnder(const Material& light) {
    PathScene made;
    addQuad(made.scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, addMaterial(made.scene, lambert(glm::vec3(1.0f))));
    addQuad(made.scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, addMaterial(made.scene, light));
    made.view = lookAt({0, 0.5f, 3}, {0, 0.5f, 0}, {0, 1, 0});
    return made;
}

TEST(PathRejected, samplesThatAreNoNumbers) {
    FilmPixel pixel = emptyPixel();
    const float infinity = std::numeric_limits<float>::infinity();
    const float notANumber = std::numeric_limits<float>::quiet_NaN();
    pixel = addSample(pixel, glm::vec3(1.0f), missFirst());
    for (const glm::vec3& radiance :
         {glm::vec3(notANumber, 1.0f, 1.0f), glm::vec3(1.0f, infinity, 1.0f),
          glm::vec3(1.0f, 1.0f, -infinity), glm::vec3(2.0f * kLargestRadiance, 0.0f, 0.0f)}) {
        pixel = addSample(pixel, radiance, missFirst());
    }
    EXPECT_EQ(pixel.samples, 5u);
    EXPECT_EQ(pixel.rejected, 4u);
    EXPECT_EQ(pixel.radiance, glm::vec3(1.0f));
    EXPECT_EQ(pixel.squares, glm::vec3(1.0f));
    EXPECT_EQ(meanOf(pixel), glm::dvec3(1.0));
}

TEST(PathRejected, enormousEmission) {
    for (const float strength : {3e38f, 1e30f}) {
        const auto film = render(floorUnder(emitter(glm::vec3(strength))), {.samples = 32});
        expectFinite(film, 32);
        EXPECT_GT(rejectedOf(film), 1000u);
    }
    // The product of factor and strength overflows.
    Material light = emitter(glm::vec3(3e38f));
    light.emissiveStrength = 3e38f;
    expectFinite(render(floorUnder(light), {.samples = 32}), 32);
    // This emission is large, but no sample is rejected.
    const auto film = render(floorUnder(emitter(glm::vec3(1e12f))), {.samples = 32});
    expectFinite(film, 32);
    EXPECT_EQ(rejectedOf(film), 0u);
}

TEST(PathRejected, lightsAtTheSurface) {
    PathScene made = floorUnder(emitter(glm::vec3(1.0f)));
    addPointLight(made.scene, {0.1f, 0, 0.1f}, 1.0f);  // on the floor
    addPointLight(made.scene, {0.1f, 1, 0.1f}, 1e30f); // on the emitter
    expectFinite(render(made, {.samples = 32}), 32);
}

// Vertex normals that cancel in the middle of a triangle, lie in its plane or point away from it may lose
// energy, but nothing else happens.
TEST(PathRejected, degenerateNormals) {
    for (const Material& material : {lambert(glm::vec3(1.0f)), metal(glm::vec3(1.0f), 0.0f),
                                     metal(glm::vec3(1.0f), 0.3f), glass(1.5f, 0.2f)}) {
        PathScene made = floorUnder(emitter(glm::vec3(1.0f)));
        made.scene.materials[0] = material;
        made.scene.normals[0] = {0, 1, 0};
        made.scene.normals[1] = {0, -1, 0};
        made.scene.normals[2] = {1, 0, 0};
        made.scene.normals[3] = {-1, 0, 0};
        made.surroundings.background = glm::vec3(1.0f);
        const auto film = render(made, {.samples = 64});
        expectFinite(film, 64);
        EXPECT_EQ(rejectedOf(film), 0u);
        EXPECT_LT(meanOf(film).r, 1.02);
    }
}

// Triangles without area are in no structure and in no light table.
TEST(PathRejected, degenerateTriangles) {
    PathScene made = floorUnder(emitter(glm::vec3(1.0f)));
    const auto before = render(made, {.samples = 8});
    addQuad(made.scene, {0, 0.5f, 0}, {0, 0, 0}, {0, 0, 0}, 1);
    addQuad(made.scene, {0, 0.5f, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, 1);
    EXPECT_EQ(shadingOf(made).emitters.size(), 2u);
    const auto after = render(made, {.samples = 8});
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_EQ(before[i].radiance, after[i].radiance);
    }
}

} // namespace
} // namespace metamarch::tests
