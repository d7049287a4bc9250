// SPDX-License-Identifier: MIT
// KHR_lights_punctual.
#include "scene/gltf_file.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

// A node at (1, 2, 3), rotated by 90 degrees about y, with light 0.
class LightFile : public GltfFile {
  public:
    explicit LightFile(const nlohmann::json& light) {
        root["extensionsRequired"] = {"KHR_lights_punctual"};
        root["extensions"]["KHR_lights_punctual"]["lights"] = {light};
        node() = {{"name", "pole"},
                  {"translation", {1, 2, 3}},
                  {"rotation", {0, 0.70710678, 0, 0.70710678}},
                  {"scale", {5, 5, 5}},
                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
    }

    PunctualLight light(const ImportOptions& options = {}) { return load(options).lights.at(0); }
};

void expectNear(const glm::vec3& a, const glm::vec3& b) { EXPECT_LT(glm::distance(a, b), 1e-6f); }

TEST(GltfLight, Directional) {
    const PunctualLight light =
        LightFile({{"type", "directional"}, {"name", "sun"}, {"intensity", 3}, {"color", {1, 0.5, 0}}})
            .light({.scale = 10.0f});
    EXPECT_EQ(light.type, PunctualLight::Type::directional);
    EXPECT_EQ(light.name, "sun");
    EXPECT_EQ(light.intensity, 3.0f); // lux do not depend on the unit of length
    EXPECT_EQ(light.color, glm::vec3(1, 0.5f, 0));
    expectNear(light.direction, {-1, 0, 0});
}

TEST(GltfLight, Point) {
    const PunctualLight light =
        LightFile({{"type", "point"}, {"intensity", 3}, {"range", 1}}).light({.scale = 10.0f});
    EXPECT_EQ(light.type, PunctualLight::Type::point);
    EXPECT_EQ(light.name, "pole");
    EXPECT_EQ(light.position, glm::vec3(10, 20, 30));
    EXPECT_EQ(light.intensity, 300.0f); // gives a surface ten times as far away the same irradiance
}

TEST(GltfLight, Spot) {
    const auto spot = [](const nlohmann::json& cone) {
        return LightFile({{"type", "spot"}, {"spot", cone}}).light();
    };
    const PunctualLight light = spot({{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}});
    EXPECT_EQ(light.type, PunctualLight::Type::spot);
    EXPECT_EQ(light.intensity, 1.0f);
    EXPECT_EQ(light.innerConeAngle, 0.25f);
    EXPECT_EQ(light.outerConeAngle, 0.5f);
    expectNear(light.direction, {-1, 0, 0});
    EXPECT_FLOAT_EQ(spot(nlohmann::json::object()).outerConeAngle, 0.785398163f);
    // These angles are out of range.
    const PunctualLight wide = spot({{"innerConeAngle", 9}, {"outerConeAngle", 3}});
    EXPECT_FLOAT_EQ(wide.outerConeAngle, 1.57079633f);
    EXPECT_EQ(wide.innerConeAngle, wide.outerConeAngle);
}

TEST(GltfLight, OneWithoutADirectionIsReported) {
    LightFile file({{"type", "spot"}, {"name", "lamp"}});
    file.node()["scale"] = {0, 0, 0};
    const Scene scene = file.load();
    EXPECT_TRUE(scene.lights.empty());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("KHR_lights_punctual light 'lamp' at node 'pole' has no place"),
              std::string::npos);
    LightFile point(nlohmann::json{{"type", "point"}});
    point.node()["scale"] = {0, 0, 0};
    EXPECT_EQ(point.load().lights.size(), 1u);
}

TEST(GltfLight, BrokenOnesAreRefused) {
    LightFile file(nlohmann::json{{"type", "candle"}});
    EXPECT_EQ(file.refusal(),
              "KHR_lights_punctual light 0: type 'candle' is none of directional, point, spot");
    file.node()["extensions"]["KHR_lights_punctual"]["light"] = 1;
    EXPECT_EQ(file.refusal(), "node 'pole': KHR_lights_punctual: light 1 does not exist, there are 1");
}

} // namespace
} // namespace metamarch
