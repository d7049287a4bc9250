// SPDX-License-Identifier: MIT
// The tree of lights: what its nodes bound, and the probabilities with which a walk chooses.
#include "metamarch/shading/light/light_tree.h"
#include "metamarch/shared/path.h"
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <vector>

namespace metamarch::tests {
namespace {

PlacedLight pointLight(const glm::dvec3& position, const double intensity) {
    return {.corners = {position, position, position},
            .axis = {0, -1, 0},
            .spread = -1.0,
            .intensity = intensity};
}

// Returns a scene with only a tree of these lights, as punctual lights.
ShadingScene sceneOf(const std::vector<PlacedLight>& lights) {
    ShadingScene scene;
    scene.lightNodes = makeLightTree(lights).nodes;
    return scene;
}

std::map<uint, float> probabilitiesAt(const ShadingScene& scene, const LightReceiver& to) {
    std::map<uint, float> found;
    for (int i = 0; i < 4096; ++i) {
        const TableChoice choice =
            chooseFromLightTree(scene, scene.settings, to, (static_cast<float>(i) + 0.5f) / 4096.0f);
        found[choice.index] = choice.probability;
    }
    return found;
}

const LightReceiver kAround(glm::vec3(0.0f), glm::vec3(0.0f)); // at the origin, lit from all sides

TEST(LightTree, followsIntensityAndDistance) {
    // The distances are 1 and 2, the intensities 1 and 12.
    const auto found =
        probabilitiesAt(sceneOf({pointLight({-1, 0, 0}, 1.0), pointLight({2, 0, 0}, 12.0)}), kAround);
    EXPECT_NEAR(found.at(0), 0.25f, 1e-6f);
    EXPECT_NEAR(found.at(1), 0.75f, 1e-6f);
}

TEST(LightTree, followsTheCosinesAtBothEnds) {
    // Two lamps of the size of a grain, at the same distance. The first is seen at 60 degrees, and lies at 0
    // degrees to the surface's normal; the second is seen at 0 degrees and lies at 45.
    const auto grain = [](const glm::dvec3& position, const glm::dvec3& normal) {
        PlacedLight light = pointLight(position, 1.0);
        light.axis = glm::normalize(normal);
        light.spread = 1.0;
        return light;
    };
    const auto found = probabilitiesAt(sceneOf({grain({0, 2, 0}, {std::sqrt(3.0), -1, 0}),
                                                grain({std::sqrt(2.0), std::sqrt(2.0), 0}, {-1, -1, 0})}),
                                       LightReceiver(glm::vec3(0.0f), glm::vec3(0, 1, 0)));
    const double expected = 0.5 / (0.5 + std::sqrt(0.5));
    EXPECT_NEAR(found.at(0), expected, 2e-3); // the axis is packed
    EXPECT_NEAR(found.at(1), 1.0 - expected, 2e-3);
}

TEST(LightTree, choosesNoLightThatGivesNone) {
    const LightReceiver upwards(glm::vec3(0.0f), glm::vec3(0, 1, 0));
    const auto below =
        probabilitiesAt(sceneOf({pointLight({0, -1, 0}, 1.0), pointLight({3, 2, 0}, 1.0)}), upwards);
    EXPECT_EQ(below.size(), 1u);
    EXPECT_EQ(below.at(1), 1.0f);
    const auto none =
        probabilitiesAt(sceneOf({pointLight({0, -1, 0}, 1.0), pointLight({3, -2, 0}, 1.0)}), upwards);
    for (const auto& [light, probability] : none) {
        EXPECT_EQ(probability, 0.0f) << light;
    }
    PlacedLight spot = pointLight({2, 1, 0}, 5.0); // shines down in a cone of 30 degrees, beside the origin
    spot.spread = 1.0;
    spot.end = std::cos(0.5236);
    const auto beside = probabilitiesAt(sceneOf({spot, pointLight({3, 2, 0}, 1.0)}), upwards);
    EXPECT_EQ(beside.at(1), 1.0f);
}

// Returns lamps of all kinds in a cloud: triangles that shine to one side or to both, points and spots.
std::vector<PlacedLight> cloud(const std::size_t count) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::vector<PlacedLight> lights;
    for (std::size_t i = 0; i < count; ++i) {
        const auto direction = [&] {
            return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        };
        const glm::dvec3 place = 3.0 * glm::dvec3(normal(random), normal(random), normal(random));
        PlacedLight light = pointLight(place, std::exp(normal(random)));
        if (i % 4 != 0) {
            light.axis = direction();
            light.spread = 1.0;
        }
        if (i % 4 == 1) {
            light.spread = i % 8 == 1 ? 1.0 : 0.3;
            light.end = 0.6;
        } else if (i % 4 != 0) {
            const glm::dvec3 side = glm::cross(light.axis, direction());
            light.corners = {place, place + side, place + glm::cross(light.axis, side)};
            light.isTwoSided = i % 8 == 2;
        }
        lights.push_back(light);
    }
    return lights;
}

// Whatever gives light to a surface can be chosen for it.
void expectNoLightLeftOut(const double scale) {
    std::vector<PlacedLight> lights = cloud(300);
    for (PlacedLight& light : lights) {
        for (glm::dvec3& corner : light.corners) {
            corner *= scale;
        }
    }
    ShadingScene scene = sceneOf(lights);
    // Every light gets a triangle, by which emitterChance finds its branches.
    for (const std::uint32_t branches : makeLightTree(lights).branches) {
        Emitter emitter{};
        emitter.triangleId = 2 * scene.settings.emitterCount++;
        emitter.branches = branches;
        scene.emitters.push_back(emitter);
    }
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::uniform_real_distribution<double> even(0.0, 1.0);
    int seen = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 position(scale * 3.0 * glm::dvec3(normal(random), normal(random), normal(random)));
        const glm::vec3 up(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
        const LightReceiver to(position, i % 2 == 0 ? up : glm::vec3(0.0f));
        double sum = 0.0;
        for (std::size_t k = 0; k < lights.size(); ++k) {
            const EmitterChance chance = emitterChance(scene, scene.settings, to, static_cast<uint>(2 * k));
            ASSERT_TRUE(chance.isWhole);
            const double probability = chance.probability;
            sum += probability;
            const PlacedLight& light = lights[k];
            const double a = even(random);
            const double b = even(random) * (1.0 - a);
            const glm::dvec3 at =
                light.corners[0] * (1.0 - a - b) + light.corners[1] * a + light.corners[2] * b;
            const glm::dvec3 wi = glm::normalize(at - glm::dvec3(position));
            const double along = -glm::dot(light.axis, wi);
            const double angle = std::acos(std::clamp(light.isTwoSided ? std::abs(along) : along, -1.0, 1.0));
            const double end = std::acos(light.spread) + std::acos(light.end);
            const double received = i % 2 == 0 ? glm::dot(wi, glm::dvec3(up)) : 1.0;
            if (angle < end - 1e-3 && received > 1e-3) {
                ++seen;
                EXPECT_GT(probability, 0.0) << "light " << k << " from point " << i;
            }
        }
        EXPECT_LE(sum, 1.0001); // a walk may end between lights that give nothing
    }
    EXPECT_GT(seen, 5000);
}

TEST(LightTree, leavesOutNoLight) { expectNoLightLeftOut(1.0); }
TEST(LightTree, leavesOutNoLightOfSmallScenes) { expectNoLightLeftOut(1e-6); }
TEST(LightTree, leavesOutNoLightOfLargeScenes) { expectNoLightLeftOut(1e6); }

// The strong light may be occluded, so the other must be drawn now and then.
TEST(LightTree, choosesWeakLightsToo) {
    const auto found =
        probabilitiesAt(sceneOf({pointLight({-1, 0, 0}, 1e9), pointLight({1, 0, 0}, 1.0)}), kAround);
    EXPECT_EQ(found.at(1), kLeastChildProbability);
    EXPECT_EQ(found.at(0), 1.0f - kLeastChildProbability);
}

TEST(LightTree, drawsAsOftenAsItSays) {
    const ShadingScene scene = sceneOf(cloud(40));
    const LightReceiver to(glm::vec3(0.3f, -0.2f, 0.5f), glm::vec3(0.6f, 0.8f, 0.0f));
    constexpr int kDraws = 100'000;
    std::map<uint, int> drawn;
    std::map<uint, float> said;
    std::map<uint, double> rests;
    for (int i = 0; i < kDraws; ++i) {
        const TableChoice choice =
            chooseFromLightTree(scene, scene.settings, to, (static_cast<float>(i) + 0.5f) / kDraws);
        ++drawn[choice.index];
        said[choice.index] = choice.probability;
        ASSERT_GE(choice.uRemapped, 0.0f);
        ASSERT_LT(choice.uRemapped, 1.0f);
        rests[choice.index] += choice.uRemapped;
    }
    EXPECT_GT(drawn.size(), 10u);
    for (const auto& [light, count] : drawn) {
        if (said[light] > 0.0f) {
            EXPECT_NEAR(static_cast<double>(count) / kDraws, said[light], 3e-5) << light; // u is stratified
        }
        if (said[light] > 0.01f) {
            EXPECT_NEAR(rests[light] / count, 0.5, 0.01) << light; // the rest of u is even again
        }
    }
}

// Lights whose places no plane divides evenly, or not at all.
TEST(LightTree, keepsWithinItsDepth) {
    std::vector<PlacedLight> lights;
    lights.reserve(5300);
    for (int i = 0; i < 300; ++i) {
        lights.push_back(pointLight({std::ldexp(1.0, i % 100 - 60), 0, 0}, std::ldexp(1.0, -(i % 90))));
    }
    for (int i = 0; i < 5000; ++i) {
        lights.push_back(pointLight({-1, 0, 0}, 1.0));
    }
    const LightTree tree = makeLightTree(lights);
    ASSERT_EQ(tree.nodes.size(), 2 * lights.size() - 1);
    for (std::uint32_t k = 0; k < lights.size(); ++k) {
        LightNode node = tree.nodes[0];
        std::uint32_t depth = 0;
        for (std::uint32_t way = tree.branches[k]; node.link < kLightLeaf; way >>= 1u) {
            ASSERT_LT(++depth, kMaxLightDepth);
            node = tree.nodes[node.link + (way & 1u)];
        }
        ASSERT_EQ(node.link, kLightLeaf | k);
    }
}

// A triangle that shines is found by its number; others have no chance.
TEST(LightTree, knowsEmittersByTheirTriangles) {
    PathScene made;
    addQuad(made.scene, {-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, addMaterial(made.scene, lambert(glm::vec3(1))));
    const std::uint32_t lamp = addMaterial(made.scene, emitter({3, 2, 1}));
    addQuad(made.scene, {-1, 2, -1}, {1, 0, 0}, {0, 0, 1}, lamp);
    addQuad(made.scene, {1, 2, 0}, {0.5f, 0, 0}, {0, 0.2f, 0.5f}, lamp);
    addQuad(made.scene, {-9, -1, 9}, {18, 0, 0}, {0, 0, -18}, addMaterial(made.scene, lambert(glm::vec3(1))));
    addPointLight(made.scene, {1, 3, 0}, 5.0f);
    const ShadingScene shading = shadingOf(made);
    ASSERT_NE(shading.features & kFeatureLightTree, 0u);
    const LightReceiver to(glm::vec3(1, 0, 0), glm::vec3(0, 1, 0));
    double sum = 0.0;
    for (std::uint32_t i = 0; i < made.scene.triangles.size(); ++i) {
        const EmitterChance chance = emitterChance(shading, shading.settings, to, i);
        EXPECT_TRUE(chance.isWhole);
        if (made.scene.triangleMaterial[i] != lamp) {
            EXPECT_EQ(chance.probability, 0.0f);
        }
        sum += chance.probability;
    }
    const uint pointIndex = shading.settings.emitterCount;
    EXPECT_NEAR(sum + probabilitiesAt(shading, to).at(pointIndex), 1.0, 1e-5);
}

// There are two panels: one shows the black half of their texture, the other the white half.
TEST(LightTree, prefersTheBrightPartsOfATexture) {
    PathScene made;
    Scene& scene = made.scene;
    TextureImage image;
    image.width = 2;
    image.height = 1;
    image.bytes = {{0, 0, 0, 255}, {255, 255, 255, 255}};
    scene.images.push_back(image);
    scene.textures.push_back({.image = 0, .wrapS = TextureWrap::clampToEdge});
    Material panel = emitter({1, 1, 1});
    panel.emissiveTexture = {0};
    const std::uint32_t material = addMaterial(scene, panel);
    addQuad(scene, {-2, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, material);
    addQuad(scene, {1, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, material);
    for (std::size_t i = 0; i < 8; ++i) {
        scene.texCoords[i] = {i < 4 ? 0.1f : 0.9f, 0.5f};
    }
    const ShadingScene shading = shadingOf(made);
    ASSERT_NE(shading.features & kFeatureLightTree, 0u);
    const LightReceiver below(glm::vec3(0.0f), glm::vec3(0, 1, 0));
    // The mean of the texture is a half, and counts for a tenth.
    EXPECT_NEAR(emitterChance(shading, shading.settings, below, 0).probability, 0.025, 1e-4);
    EXPECT_NEAR(emitterChance(shading, shading.settings, below, 2).probability, 0.475, 1e-3);
}

} // namespace
} // namespace metamarch::tests
