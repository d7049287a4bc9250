// SPDX-License-Identifier: MIT
// MikkTSpace, with values worked out by hand and against the tangents of other exporters.
#include "fixtures/shared_scenes.h"
#include "metamarch/scene/tangent_space.h"
#include "scene/gltf_file.h"
#include "scene/picture_file.h"

#include <gtest/gtest.h>

#include <limits>

namespace metamarch {
namespace {

using Corners = std::vector<TangentCorner>;

const glm::vec3 kUp{0, 0, 1};

// Returns a corner in the plane z = 0.
TangentCorner corner(float x, float y, float s, float t) { return {{x, y, 0}, kUp, {s, t}}; }

void expectTangent(const glm::vec4& found, const glm::vec3& direction, float sign) {
    EXPECT_LT(glm::distance(glm::vec3(found), direction), 1e-6f)
        << found.x << ' ' << found.y << ' ' << found.z;
    EXPECT_EQ(found.w, sign);
}

TEST(TangentSpace, FollowsS) {
    for (const glm::vec4& tangent :
         mikkTangents(Corners{corner(0, 0, 0, 0), corner(1, 0, 1, 0), corner(0, 1, 0, 1)})) {
        expectTangent(tangent, {1, 0, 0}, 1.0f);
    }
    // A quarter turn in texture space: s grows with y.
    for (const glm::vec4& tangent :
         mikkTangents(Corners{corner(0, 0, 0, 0), corner(1, 0, 0, -1), corner(0, 1, 1, 0)})) {
        expectTangent(tangent, {0, 1, 0}, 1.0f);
    }
}

TEST(TangentSpace, MirroredTextureHasTheOtherSign) {
    for (const glm::vec4& tangent :
         mikkTangents(Corners{corner(0, 0, 0, 0), corner(1, 0, -1, 0), corner(0, 1, 0, 1)})) {
        expectTangent(tangent, {-1, 0, 0}, -1.0f);
    }
}

// Two triangles at the corner (0,0), with angles of 90 and 45 degrees, whose tangents are (1,0) and (1,1) /
// sqrt 2.
TEST(TangentSpace, MeanIsWeightedByAngles) {
    const Corners corners = {corner(0, 0, 0, 0), corner(1, 0, 1, 0), corner(0, 1, 0, 1),
                             corner(0, 0, 0, 0), corner(0, 1, 0, 1), corner(-1, 1, -1, 2)};
    const std::vector<glm::vec4> tangents = mikkTangents(corners);
    const float diagonal = std::sqrt(0.5f);
    const glm::vec3 mean = glm::normalize(glm::vec3(2.0f + diagonal, diagonal, 0));
    expectTangent(tangents[0], mean, 1.0f);
    EXPECT_EQ(tangents[3], tangents[0]);
    EXPECT_EQ(tangents[4], tangents[2]); // the other shared corner
    expectTangent(tangents[1], {1, 0, 0}, 1.0f);
    expectTangent(tangents[5], {diagonal, diagonal, 0}, 1.0f);
}

TEST(TangentSpace, MirrorSeamKeepsItsSidesApart) {
    // Texture space is folded at x = 0.
    const Corners corners = {corner(0, 0, 0, 0), corner(1, 0, 1, 0), corner(0, 1, 0, 1),
                             corner(0, 0, 0, 0), corner(0, 1, 0, 1), corner(-1, 0, 1, 0)};
    const std::vector<glm::vec4> tangents = mikkTangents(corners);
    for (std::size_t i = 0; i < 3; ++i) {
        expectTangent(tangents[i], {1, 0, 0}, 1.0f);
    }
    for (std::size_t i = 3; i < 6; ++i) {
        expectTangent(tangents[i], {-1, 0, 0}, -1.0f);
    }
}

// Triangles that share only a corner, or an edge with different normals, are not averaged.
TEST(TangentSpace, OnlyEdgesOfEqualCornersConnect) {
    const float diagonal = std::sqrt(0.5f);
    Corners corners = {corner(0, 0, 0, 0), corner(1, 0, 1, 0),   corner(1, 1, 1, 1),
                       corner(0, 0, 0, 0), corner(-1, 0, -1, 1), corner(-1, -1, -1, 0)};
    std::vector<glm::vec4> tangents = mikkTangents(corners);
    expectTangent(tangents[0], {1, 0, 0}, 1.0f);
    EXPECT_GT(glm::distance(tangents[3], tangents[0]), 0.1f);

    corners = {corner(0, 0, 0, 0), corner(1, 0, 1, 0), corner(0, 1, 0, 1),
               corner(0, 0, 0, 0), corner(0, 1, 0, 1), corner(-1, 1, -1, 2)};
    for (std::size_t i = 3; i < 6; ++i) {
        corners[i].normal = {0, diagonal, diagonal};
    }
    tangents = mikkTangents(corners);
    expectTangent(tangents[0], {1, 0, 0}, 1.0f);
}

TEST(TangentSpace, TangentLiesInThePlaneOfTheNormal) {
    Corners corners = {corner(0, 0, 0, 0), corner(1, 0, 1, 0), corner(0, 1, 0, 1)};
    corners[0].normal = {0.6f, 0, 0.8f};
    expectTangent(mikkTangents(corners)[0], {0.8f, 0, -0.6f}, 1.0f);
}

// The second triangle has no area in texture space, the third has no area at all.
TEST(TangentSpace, DegenerateTrianglesTakeFromTheirNeighbours) {
    const Corners corners = {corner(0, 0, 0, 0), corner(1, 0, 1, 0), corner(0, 1, 0, 1),
                             corner(0, 0, 0, 0), corner(0, 1, 0, 1), corner(-1, 0, 0, 0),
                             corner(1, 0, 1, 0), corner(1, 0, 1, 0), corner(5, 5, 5, 5)};
    const std::vector<glm::vec4> tangents = mikkTangents(corners);
    expectTangent(tangents[3], {1, 0, 0}, 1.0f);
    expectTangent(tangents[4], {1, 0, 0}, 1.0f);
    expectTangent(tangents[5], {1, 0, 0}, 1.0f); // arbitrary, because the corner has no other triangle
    expectTangent(tangents[6], {1, 0, 0}, 1.0f);
    expectTangent(tangents[8], {1, 0, 0}, 1.0f);
}

TEST(TangentSpace, GarbageGivesFiniteTangents) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kHuge = std::numeric_limits<float>::max();
    constexpr float kTiny = std::numeric_limits<float>::denorm_min();
    Corners corners;
    for (const float a : {kNan, kHuge, -kHuge, kTiny, 0.0f, 1.0f}) {
        for (const float b : {kNan, kHuge, kTiny, 0.0f}) {
            corners.push_back({{a, b, 1}, {b, a, 1}, {a, b}});
            corners.push_back({{b, 1, a}, {0, 0, 0}, {1, a}});
            corners.push_back({{1, b, 0}, {a, a, a}, {b, 0}});
        }
    }
    for (const glm::vec4& tangent : mikkTangents(corners)) {
        EXPECT_TRUE(std::isfinite(tangent.x) && std::isfinite(tangent.y) && std::isfinite(tangent.z));
        EXPECT_NE(glm::vec3(tangent), glm::vec3(0));
    }
}

// A square folded along its diagonal in texture space, with v downwards, a normal map and no tangents.
class NormalMappedFile : public GltfFile {
  public:
    NormalMappedFile() {
        setPositions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        primitive()["attributes"]["NORMAL"] = addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
        primitive()["attributes"]["TEXCOORD_0"] = addFloats("VEC2", 2, {0, 1, 1, 1, 1, 0, 1, 1});
        primitive()["indices"] = addIndices({0, 1, 2, 0, 2, 3});
        primitive()["material"] = 0;
        root["materials"] = {{{"normalTexture", {{"index", 0}}}}};
        root["textures"] = {{{"source", 0}}};
        root["images"] = {{{"uri", "flat.png"}}};
        writeFile(folder / "flat.png", onePixelPng({128, 128, 255, 255}));
    }
};

TEST(SceneTangents, ComputedWhereTheFileHasNone) {
    NormalMappedFile file;
    const Scene scene = file.load();
    // The two vertices on the fold are split: one copy for each side.
    ASSERT_EQ(scene.positions.size(), 6u);
    EXPECT_EQ(scene.normals.size(), 6u);
    ASSERT_EQ(scene.tangents.size(), 6u);
    EXPECT_EQ(scene.triangles, std::vector<glm::uvec3>({{0, 1, 2}, {4, 5, 3}}));
    EXPECT_EQ(scene.positions[4], scene.positions[0]);
    EXPECT_EQ(scene.texCoords[5], scene.texCoords[2]);
    expectTangent(scene.tangents[0], {1, 0, 0}, 1.0f);
    expectTangent(scene.tangents[3], {0, 1, 0}, -1.0f);
}

TEST(SceneTangents, NeitherWithoutANormalMapNorWithoutCoordinates) {
    NormalMappedFile file;
    file.primitive()["attributes"].erase("TEXCOORD_0");
    EXPECT_TRUE(file.load().tangents.empty());
    NormalMappedFile plain;
    plain.root["materials"][0] = nlohmann::json::object();
    EXPECT_TRUE(plain.load().tangents.empty());
}

TEST(SceneTangents, OfTheFileAreCarriedToTheWorld) {
    NormalMappedFile file;
    file.primitive()["attributes"]["TANGENT"] =
        file.addFloats("VEC4", 4, {1, 0, 0, 1, 1, 0, 0, -1, 0, 1, 0, 1, 0, 0, 0, 1});
    file.node()["scale"] = {-2, 3, 1};
    const Scene scene = file.load();
    ASSERT_EQ(scene.tangents.size(), 4u);
    expectTangent(scene.tangents[0], {-1, 0, 0}, -1.0f);
    expectTangent(scene.tangents[1], {-1, 0, 0}, 1.0f);
    expectTangent(scene.tangents[2], {0, 1, 0}, -1.0f);
    EXPECT_EQ(scene.tangents[3], glm::vec4(0));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("1 tangents are zero or not finite"), std::string::npos);
}

TEST(SceneTangents, WithoutNormalsTheFilesAreIgnored) {
    NormalMappedFile file;
    file.primitive()["attributes"].erase("NORMAL");
    file.primitive()["attributes"]["TANGENT"] =
        file.addFloats("VEC4", 4, {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1});
    const Scene scene = file.load();
    EXPECT_EQ(scene.normals[0], glm::vec3(0));
    expectTangent(scene.tangents[0], {1, 0, 0}, 1.0f);
}

TEST(SceneTangents, FirstPrimitiveThatHasThemPadsTheOthers) {
    NormalMappedFile file;
    const nlohmann::json mapped = file.primitive();
    nlohmann::json plain = mapped;
    plain.erase("material");
    file.root["meshes"][0]["primitives"] = {plain, mapped, plain};
    const Scene scene = file.load();
    ASSERT_EQ(scene.tangents.size(), 4u + 6u + 4u);
    EXPECT_EQ(scene.tangents[3], glm::vec4(0));
    EXPECT_NE(scene.tangents[4], glm::vec4(0));
    EXPECT_EQ(scene.tangents[10], glm::vec4(0));
}

// The tangents that exporters with Mikkelsen's own code wrote, corner by corner.
TEST(SharedScenes, TangentsAreThoseOfOtherPrograms) {
    for (const char* const name :
         {"AlphaBlendModeTest.glb", "AnisotropyStrengthTest.glb", "SheenCloth/SheenCloth.gltf"}) {
        const Scene scene = loadScene(tests::sharedScene(std::string("gltf/") + name));
        for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
            Corners corners;
            std::vector<glm::vec4> expected;
            for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
                for (int k = 0; k < 3 && scene.triangleMesh[i] == mesh; ++k) {
                    const std::uint32_t vertex = scene.triangles[i][k];
                    const glm::vec2 texCoord = scene.texCoords[vertex];
                    corners.push_back(
                        {scene.positions[vertex], scene.normals[vertex], {texCoord.x, 1.0f - texCoord.y}});
                    expected.push_back(scene.tangents[vertex]);
                }
            }
            const std::vector<glm::vec4> found = mikkTangents(corners);
            std::size_t different = 0;
            for (std::size_t i = 0; i < found.size(); ++i) {
                // 0.8 degrees, for the files' own rounding and for very thin triangles.
                const bool same = glm::dot(glm::vec3(found[i]), glm::vec3(expected[i])) > 0.9999f &&
                                  found[i].w == expected[i].w;
                different += same || expected[i] == glm::vec4(0) ? 0 : 1;
            }
            EXPECT_LE(different, corners.size() / 10000) << name << ", mesh " << mesh;
        }
    }
}

} // namespace
} // namespace metamarch
