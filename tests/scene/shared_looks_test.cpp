// SPDX-License-Identifier: MIT
// Materials, textures, lights and poses of other people's files, as their JSON and their descriptions state.
#include "fixtures/shared_scenes.h"
#include "metamarch/scene/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace metamarch {
namespace {

class SharedLooks : public testing::Test {
  protected:
    Scene load(const std::string& name, const ImportOptions& options = {}) const {
        return loadScene(tests::sharedScene("gltf/" + name), options);
    }

    static const Material& material(const Scene& scene, const std::string& name) {
        const auto found = std::ranges::find(scene.materials, name, &Material::name);
        return found != scene.materials.end() ? *found : throw std::out_of_range(name);
    }
};

TEST_F(SharedLooks, TexturesAndImagesInUse) {
    const std::map<std::string, std::pair<std::size_t, std::size_t>> counts = {
        {"BoxTextured.glb", {1, 1}},
        {"DamagedHelmet.glb", {4, 4}}, // five with the occlusion map, which is ignored
        {"MultiUVTest.glb", {2, 2}},
        {"TextureSettingsTest.glb", {9, 3}},
        {"TextureTransformMultiTest.glb", {25, 4}},
        {"ClearCoatTest.glb", {10, 6}},
        {"LightsPunctualLamp/LightsPunctualLamp.gltf", {7, 7}},
        {"embedded/BoxTextured.gltf", {1, 1}},
        {"Box With Spaces/Box With Spaces.gltf", {3, 3}},
        {"Unicode❤♻Test.glb", {1, 1}},
        {"UnlitTest.glb", {0, 0}},
    };
    for (const auto& [name, expected] : counts) {
        const Scene scene = load(name);
        EXPECT_EQ(scene.textures.size(), expected.first) << name;
        EXPECT_EQ(scene.images.size(), expected.second) << name;
        for (const TextureImage& image : scene.images) {
            EXPECT_EQ(image.bytes.size(), std::size_t{image.width} * image.height) << name;
        }
    }
    EXPECT_EQ(load("BoxTexturedNonPowerOfTwo.glb").images[0].width, 211u);
}

TEST_F(SharedLooks, EveryExtensionOfTheTestModels) {
    const Scene clearcoat = load("ClearCoatTest.glb");
    EXPECT_EQ(material(clearcoat, "Partial_Coated").clearcoatFactor, 1.0f);
    EXPECT_EQ(material(clearcoat, "Partial_Coated").clearcoatRoughnessFactor, 0.03f);
    EXPECT_NE(material(clearcoat, "Partial_Coated").clearcoatTexture.texture, kNoTexture);
    EXPECT_EQ(material(load("SpecularTest.glb"), "M1.3_specFac").specularFactor, 0.212231f);
    EXPECT_EQ(material(load("EmissiveStrengthTest.glb"), "Emit16").emissiveStrength, 16.0f);
    EXPECT_EQ(load("AnisotropyStrengthTest.glb").materials[3].anisotropyStrength, 0.5f);
    EXPECT_TRUE(material(load("UnlitTest.glb"), "Orange").unlit);
    EXPECT_EQ(material(load("TransmissionTest.glb"), "YellowTrans").transmissionFactor, 1.0f);
    const Scene attenuation = load("AttenuationTest.glb", {.scale = 3.0f});
    EXPECT_EQ(material(attenuation, "R2_ThicknessFac_1.5").thicknessFactor, 4.5f);
    EXPECT_EQ(material(attenuation, "R2_ThicknessFac_1.5").attenuationDistance, 3.0f);
    EXPECT_EQ(material(attenuation, "R2_ThicknessFac_1.5").attenuationColor, glm::vec3(0.1f, 0.5f, 0.9f));
    const Scene iridescence = load("IridescenceSuzanne.glb");
    EXPECT_EQ(iridescence.materials[2].iridescenceThicknessMinimum, 200.0f);
    EXPECT_EQ(iridescence.materials[2].iridescenceIor, 1.8f);
    EXPECT_NE(iridescence.materials[2].iridescenceThicknessTexture.texture, kNoTexture);
    EXPECT_EQ(iridescence.materials[0].ior, 2.0f);
    const Scene sheen = load("SheenCloth/SheenCloth.gltf");
    EXPECT_NE(sheen.materials[0].sheenColorTexture.texture, kNoTexture);
    EXPECT_EQ(sheen.materials[0].baseColorTexture.transform * glm::vec3(1, 1, 1), glm::vec2(30, -30));
}

// The arrow, rotated by 22.5 degrees, must point to the green marker below and to the left of the centre. The
// arrow's tip, (0.85, 0.85) in its image, is visible where the look-up maps to it.
TEST_F(SharedLooks, RotatedArrowPointsToTheGreenMarker) {
    const Scene scene = load("TextureTransformTest/TextureTransformTest.gltf");
    const auto rotated = std::ranges::find_if(scene.materials, [](const Material& candidate) {
        const TextureRef& ref = candidate.baseColorTexture;
        return ref.transform[0][1] != 0.0f && ref.transform[2] == glm::vec2(0);
    });
    ASSERT_NE(rotated, scene.materials.end());
    const glm::vec2 down = rotated->baseColorTexture.transform * glm::vec3(0.4f, 1.0f, 1.0f);
    EXPECT_NEAR(down.x, down.y, 0.05f); // on the diagonal, like the arrow
}

TEST_F(SharedLooks, MorphAtATime) {
    // The weights go from 0, 0 to 0, 1 to 1, 1 to 1, 0 to 0, 0, one second each.
    const auto third = [&](double seconds) {
        return load("SimpleMorph/SimpleMorph.gltf", {.time = seconds}).positions[2];
    };
    EXPECT_EQ(third(0), glm::vec3(0.5f, 0.5f, 0));
    EXPECT_EQ(third(1), glm::vec3(1.5f, 1.5f, 0));
    EXPECT_EQ(third(1.5), glm::vec3(1, 2, 0));
    EXPECT_EQ(third(2), glm::vec3(0.5f, 2.5f, 0));
    EXPECT_EQ(load("SimpleMorph/SimpleMorph.gltf").positions[2], glm::vec3(0.5f + 0.5f - 0.5f, 1.5f, 0));
}

TEST_F(SharedLooks, SkinAtATime) {
    // At one second the upper joint, at (0, 1, 0), is rotated to the left by 90 degrees.
    const Scene rest = load("SimpleSkin/SimpleSkin.gltf");
    const Scene bent = load("SimpleSkin/SimpleSkin.gltf", {.time = 1.0});
    for (std::size_t i = 0; i < rest.positions.size(); ++i) {
        const glm::vec3 p = rest.positions[i];
        if (p.y == 0.0f) {
            EXPECT_LT(glm::distance(bent.positions[i], p), 1e-6f);
        } else if (p.y == 2.0f) {
            EXPECT_LT(glm::distance(bent.positions[i], glm::vec3(1.0f - p.y, 1.0f + p.x, 0)), 1e-5f);
        }
    }
    const Bounds still = boundsOf(load("CesiumMan.glb"));
    const Bounds walking = boundsOf(load("CesiumMan.glb", {.time = 1.0}));
    EXPECT_GT(still.hi.y, 1.4f); // he stands upright and is 1.5 m tall
    EXPECT_LT(std::abs(still.hi.y - walking.hi.y), 0.1f);
    EXPECT_GT(glm::distance(still.hi, walking.hi), 0.1f); // and has lowered his arms
}

TEST_F(SharedLooks, CompressedDuckIsTheDuck) {
    const Bounds plain = boundsOf(load("Duck.glb"));
    const glm::vec3 size = plain.hi - plain.lo;
    for (const char* name : {"Duck-Draco/Duck.gltf", "Duck-Quantized/Duck.gltf"}) {
        const Bounds bounds = boundsOf(load(name));
        // Positions are quantised to 11 bits or more.
        EXPECT_LT(glm::distance(bounds.lo, plain.lo), glm::length(size) / 1024) << name;
        EXPECT_LT(glm::distance(bounds.hi, plain.hi), glm::length(size) / 1024) << name;
    }
}

} // namespace
} // namespace metamarch
