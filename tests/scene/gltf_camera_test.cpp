// SPDX-License-Identifier: MIT
// Cameras of glTF.
#include "scene/gltf_file.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

TEST(GltfCamera, PerspectiveAtItsNode) {
    GltfFile file;
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    // A quarter turn about y makes it look along -x; the scale must not matter.
    file.root["nodes"] = {{{"camera", 0},
                           {"name", "front"},
                           {"translation", {1, 2, 3}},
                           {"rotation", {0, 0.70710678, 0, 0.70710678}},
                           {"scale", {7, 7, 7}}}};
    const Scene scene = file.load({.scale = 10.0f});
    ASSERT_EQ(scene.cameras.size(), 1u);
    const SceneCamera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "front");
    EXPECT_EQ(camera.projection, SceneCamera::Projection::perspective);
    EXPECT_EQ(camera.verticalFov, 0.5f);
    EXPECT_EQ(camera.eye, glm::vec3(10, 20, 30));
    EXPECT_LT(glm::distance(camera.forward, glm::vec3(-1, 0, 0)), 1e-7f);
    EXPECT_LT(glm::distance(camera.up, glm::vec3(0, 1, 0)), 1e-7f);
}

// glTF 2.0, 3.10.2: scaling is left out of the view. A mirror above the camera moves what it looks at.
TEST(GltfCamera, MirroringNodes) {
    GltfFile file;
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    const auto camera = [&](const nlohmann::json& own, const nlohmann::json& above) {
        // A quarter turn about y makes the camera look along -x.
        file.root["nodes"] = {{{"children", {1}}, {"scale", above}},
                              {{"camera", 0}, {"rotation", {0, 0.70710678, 0, 0.70710678}}, {"scale", own}}};
        return file.load().cameras.at(0);
    };
    for (const std::vector<double>& own :
         std::vector<std::vector<double>>{{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {-2, -3, -4}}) {
        EXPECT_LT(glm::distance(camera(own, {1, 1, 1}).forward, glm::vec3(-1, 0, 0)), 1e-6f);
        EXPECT_LT(glm::distance(camera(own, {1, 1, 1}).up, glm::vec3(0, 1, 0)), 1e-6f);
    }
    EXPECT_LT(glm::distance(camera({1, 1, 1}, {-1, 1, 1}).forward, glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(camera({1, 1, 1}, {-1, 1, 1}).up, glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(glm::distance(camera({1, 1, 1}, {1, -1, 1}).up, glm::vec3(0, -1, 0)), 1e-6f);
}

TEST(GltfCamera, OrthographicGrowsWithTheImportScale) {
    GltfFile file;
    file.root["cameras"] = {{{"type", "orthographic"},
                             {"name", "plan"},
                             {"orthographic", {{"xmag", 1}, {"ymag", 3}, {"znear", 0.1}, {"zfar", 9}}}}};
    file.root["nodes"] = {{{"camera", 0}, {"name", "node"}}};
    const Scene scene = file.load({.scale = 2.0f});
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "plan");
    EXPECT_EQ(scene.cameras[0].projection, SceneCamera::Projection::orthographic);
    EXPECT_EQ(scene.cameras[0].verticalExtent, 12.0f);
}

TEST(GltfCamera, OneThatShowsNothingIsReported) {
    GltfFile file;
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    file.root["nodes"] = {{{"camera", 0}, {"scale", {0, 0, 0}}}};
    Scene scene = file.load();
    EXPECT_TRUE(scene.cameras.empty());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with("camera 0 at node 0 shows nothing and is left out"));
    file.root["nodes"][0].erase("scale");
    file.root["cameras"][0]["perspective"]["yfov"] = 4;
    EXPECT_TRUE(file.load().cameras.empty());
}

} // namespace
} // namespace metamarch
