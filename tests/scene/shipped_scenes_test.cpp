// SPDX-License-Identifier: MIT
// The scenes that tools/make_scenes writes.
#include "metamarch/scene/import.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

Scene load(const std::string& name) {
    return loadScene(std::filesystem::path(METAMARCH_SOURCE_DIR) / "scenes" / name);
}

// Returns the number of triangles whose vertex normals point to the back side.
std::size_t contradictions(const Scene& scene) {
    std::size_t count = 0;
    for (const glm::uvec3& corner : scene.triangles) {
        const glm::vec3 front = glm::cross(scene.positions[corner.y] - scene.positions[corner.x],
                                           scene.positions[corner.z] - scene.positions[corner.x]);
        for (int i = 0; i < 3; ++i) {
            count += glm::dot(front, scene.normals[corner[i]]) > 0.0f ? 0 : 1;
        }
    }
    return count;
}

TEST(ShippedScenes, Cornell) {
    const Scene scene = load("cornell.glb");
    EXPECT_EQ(scene.triangles.size(), 32u);
    EXPECT_EQ(scene.meshes.size(), 6u);
    EXPECT_EQ(contradictions(scene), 0u);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    ASSERT_EQ(scene.materials.size(), 4u);
    EXPECT_EQ(scene.materials[3].emissiveFactor.r * scene.materials[3].emissiveStrength, 17.0f);
    EXPECT_TRUE(scene.warnings.empty());
    const Bounds bounds = boundsOf(scene);
    EXPECT_LT(glm::distance(bounds.hi - bounds.lo, glm::vec3(0.556f, 0.5488f, 0.5592f)), 1e-4f);
}

// The room's faces show their fronts to its centre, the blocks' faces their backs.
TEST(ShippedScenes, CornellFronts) {
    const Scene scene = load("cornell.glb");
    std::vector<Bounds> boxes(scene.meshes.size(), {glm::vec3(1e9f), glm::vec3(-1e9f)});
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            Bounds& box = boxes[scene.triangleMesh[i]];
            box.lo = glm::min(box.lo, scene.positions[scene.triangles[i][corner]]);
            box.hi = glm::max(box.hi, scene.positions[scene.triangles[i][corner]]);
        }
    }
    const Bounds all = boundsOf(scene);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::string& mesh = scene.meshes[scene.triangleMesh[i]].name;
        const bool isBlock = mesh.ends_with("block");
        const Bounds& box = isBlock ? boxes[scene.triangleMesh[i]] : all;
        const glm::vec3 toMiddle = (box.lo + box.hi) * 0.5f - scene.positions[scene.triangles[i].x];
        const float side = glm::dot(scene.normals[scene.triangles[i].x], toMiddle);
        EXPECT_TRUE(isBlock ? side < 0.0f : side > 0.0f) << mesh << ", triangle " << i;
    }
}

TEST(ShippedScenes, Objects) {
    const Scene scene = load("objects.glb");
    EXPECT_EQ(scene.positions.size(), 8808u);
    EXPECT_EQ(scene.triangles.size(), 17044u);
    EXPECT_EQ(scene.meshes.size(), 24u);
    EXPECT_EQ(contradictions(scene), 0u);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(ShippedScenes, Degenerate) {
    const Scene scene = load("degenerate.glb");
    EXPECT_EQ(scene.positions.size(), 236u);
    EXPECT_EQ(scene.triangles.size(), 149u);
    EXPECT_EQ(scene.meshes.size(), 14u);
    EXPECT_TRUE(scene.warnings.empty());
}

} // namespace
} // namespace metamarch
