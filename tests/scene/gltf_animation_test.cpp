// SPDX-License-Identifier: MIT
// Animations, skins and morph targets of glTF, with values worked out by hand.
#include "fixtures/expect_error.h"
#include "fixtures/shared_scenes.h"
#include "metamarch/error/error.h"
#include "scene/gltf_file.h"

#include <gtest/gtest.h>

#include <limits>

namespace metamarch {
namespace {

using Json = nlohmann::json;
using Positions = std::vector<glm::vec3>;

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LT(glm::distance(a, b), 1e-5f) << a.x << ' ' << a.y << ' ' << a.z;
}

// Node 0 holds the triangle and is animated by one channel, with keyframes at 1, 2 and 4 seconds.
class AnimatedFile : public TriangleFile {
  public:
    AnimatedFile(const char* path, const char* interpolation, const char* type, std::size_t size,
                 const std::vector<float>& values) {
        root["animations"] = Json::array();
        addAnimation(path, interpolation, addFloats(type, size, values));
    }

    void addAnimation(const char* path, const char* interpolation, int output) {
        const int input = addFloats("SCALAR", 1, {1, 2, 4});
        root["animations"].push_back(
            {{"name", path},
             {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
    }

    Positions at(double seconds, const std::string& animation = "") {
        return load({.time = seconds, .animation = animation}).positions;
    }
};

TEST(GltfAnimation, LinearBetweenKeysAndStillOutside) {
    AnimatedFile file("translation", "LINEAR", "VEC3", 3, {0, 0, 0, 10, 0, 0, 10, 20, 0});
    file.node()["translation"] = {0, 0, 7};
    EXPECT_EQ(file.load().positions[0], glm::vec3(0, 0, 7)); // the pose in the file
    expectNear(file.at(-5)[0], {0, 0, 0});
    expectNear(file.at(1)[0], {0, 0, 0});
    expectNear(file.at(1.5)[0], {5, 0, 0});
    expectNear(file.at(2)[0], {10, 0, 0});
    expectNear(file.at(3.5)[0], {10, 15, 0});
    expectNear(file.at(99)[0], {10, 20, 0});
}

TEST(GltfAnimation, StepHoldsTheKeyBefore) {
    AnimatedFile file("translation", "STEP", "VEC3", 3, {0, 0, 0, 10, 0, 0, 10, 20, 0});
    expectNear(file.at(1.99)[0], {0, 0, 0});
    expectNear(file.at(2)[0], {10, 0, 0});
    expectNear(file.at(3.99)[0], {10, 0, 0});
    expectNear(file.at(4)[0], {10, 20, 0});
}

// Each keyframe has in-tangent, value and out-tangent. In the middle of an interval of d seconds the value is
// (v0 + v1) / 2 + d (b0 - a1) / 8.
TEST(GltfAnimation, CubicSplineIsHermites) {
    AnimatedFile file("translation", "CUBICSPLINE", "VEC3", 3, {9, 9,  9, 0, 0, 0, 8,  0,  0, //
                                                                0, 4,  0, 2, 2, 2, 0,  0,  4, //
                                                                0, -4, 0, 4, 2, 2, 99, 99, 99});
    expectNear(file.at(1)[0], {0, 0, 0});
    expectNear(file.at(1.5)[0], {1 + 1, 1 - 0.5f, 1});
    expectNear(file.at(2)[0], {2, 2, 2});
    expectNear(file.at(3)[0], {3, 2 + 1, 2 + 1});
    expectNear(file.at(5)[0], {4, 2, 2});
}

TEST(GltfAnimation, RotationTakesTheShortWayAtEvenSpeed) {
    const float half = std::sqrt(0.5f);
    // No rotation, then 90 degrees about z, then the same rotation as the negated quaternion.
    AnimatedFile file("rotation", "LINEAR", "VEC4", 4, {0, 0, 0, 1, 0, 0, half, half, 0, 0, -half, -half});
    const auto turned = [](double degrees) {
        const double angle = degrees * 3.14159265358979 / 180.0;
        return glm::vec3(std::cos(angle), std::sin(angle), 0);
    };
    expectNear(file.at(1.0)[1], turned(0));
    expectNear(file.at(1.25)[1], turned(22.5));
    expectNear(file.at(1.5)[1], turned(45));
    expectNear(file.at(3.0)[1], turned(90));
}

TEST(GltfAnimation, NormalizedIntegersAreRotations) {
    AnimatedFile file("rotation", "LINEAR", "VEC4", 4, std::vector<float>(12, 0.0f));
    const int view = file.addView<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0, 0, 0, 32767, 0});
    file.root["animations"][0]["samplers"][0]["output"] =
        file.addAccessor({{"bufferView", view},
                          {"componentType", GltfFile::kShort},
                          {"normalized", true},
                          {"count", 3},
                          {"type", "VEC4"}});
    expectNear(file.at(2)[1], {-1, 0, 0});
}

TEST(GltfAnimation, ScaleOfAParentMovesItsChildren) {
    AnimatedFile file("scale", "LINEAR", "VEC3", 3, {1, 1, 1, 3, 1, 1, 3, 1, 1});
    file.root["nodes"] = {{{"children", {1}}}, {{"mesh", 0}, {"translation", {2, 0, 0}}}};
    expectNear(file.at(1.5)[0], {4, 0, 0});
}

TEST(GltfAnimation, AllOrOneByNameOrIndex) {
    AnimatedFile file("translation", "LINEAR", "VEC3", 3, {5, 0, 0, 5, 0, 0, 5, 0, 0});
    file.addAnimation("scale", "LINEAR", file.addVec3({2, 2, 2, 2, 2, 2, 2, 2, 2}));
    expectNear(file.at(0)[1], {7, 0, 0});
    expectNear(file.at(0, "translation")[1], {6, 0, 0});
    expectNear(file.at(0, "1")[1], {2, 0, 0});
    expectError(ErrorKind::invalidArgument,
                "there is no animation walk; the file has 0 'translation', 1 'scale'", {"animation"},
                [&] { file.at(0, "walk"); });
    TriangleFile still;
    expectError(ErrorKind::invalidArgument, "there is no animation walk; the file has none", {"animation"},
                [&] { still.load({.time = 0.0, .animation = "walk"}); });
    EXPECT_TRUE(still.load({.time = 0.0}).warnings.at(0).ends_with("it looks the same at any time"));
}

// The viewer's slider goes to the last key, also where the file does not declare it as the accessor's
// maximum.
TEST(GltfAnimation, NamesAndLengthsAreOfTheScene) {
    AnimatedFile file("translation", "LINEAR", "VEC3", 3, {5, 0, 0, 5, 0, 0, 5, 0, 0});
    file.addAnimation("scale", "LINEAR", file.addVec3({2, 2, 2, 2, 2, 2, 2, 2, 2}));
    file.root["animations"][1]["samplers"][0]["input"] = file.addFloats("SCALAR", 1, {0, 1.5f, 2.5f});
    file.root["animations"].push_back(
        {{"samplers", {{{"input", 99}}}}, {"channels", Json::array()}}); // broken
    const Scene scene = file.load();
    ASSERT_EQ(scene.animations.size(), 3u);
    EXPECT_EQ(scene.animations[0].name, "translation");
    EXPECT_EQ(scene.animations[0].seconds, 4.0);
    EXPECT_EQ(scene.animations[1].name, "scale");
    EXPECT_EQ(scene.animations[1].seconds, 2.5);
    EXPECT_EQ(scene.animations[2].seconds, 0.0);
    EXPECT_EQ(scene.animationSeconds(), 4.0);
    EXPECT_EQ(TriangleFile().load().animationSeconds(), 0.0);
}

TEST(GltfAnimation, BrokenOnesAreRefused) {
    const auto refusal = [](AnimatedFile& file) {
        return lineOfError(ErrorKind::inputRefused, [&] { file.at(0); })
            .substr((file.folder / "scene.gltf").string().size() + 2);
    };
    const std::vector<float> three = {0, 0, 0, 1, 0, 0, 1, 2, 0};
    const std::vector<std::pair<Json, std::string>> cases = {
        {{{{"op", "replace"}, {"path", "/channels/0/target/node"}, {"value", 9}}},
         "animation 'translation' channel 0: target: node 9 does not exist, there are 1"},
        {{{{"op", "replace"}, {"path", "/channels/0/sampler"}, {"value", 9}}},
         "animation 'translation' channel 0: sampler 9 does not exist, there are 1"},
        {{{{"op", "remove"}, {"path", "/channels/0/sampler"}}},
         "animation 'translation' channel 0: has no sampler"},
        {{{{"op", "remove"}, {"path", "/samplers/0/input"}}},
         "animation 'translation' sampler 0: has no input"},
        {{{{"op", "replace"}, {"path", "/samplers/0/output"}, {"value", 9}}},
         "animation 'translation' sampler 0: output: accessor 9 does not exist, there are 3"},
        {{{{"op", "replace"}, {"path", "/samplers/0/interpolation"}, {"value", "BOUNCE"}}},
         "animation 'translation' sampler 0: interpolation 'BOUNCE' is none of LINEAR, STEP, CUBICSPLINE"},
        {{{{"op", "replace"}, {"path", "/samplers/0/interpolation"}, {"value", "CUBICSPLINE"}}},
         "animation 'translation' sampler 0: 3 times, but 3 values"},
    };
    for (const auto& [patch, line] : cases) {
        AnimatedFile file("translation", "LINEAR", "VEC3", 3, three);
        file.root["animations"][0] = file.root["animations"][0].patch(patch);
        EXPECT_EQ(refusal(file), line);
    }
    AnimatedFile unordered("translation", "LINEAR", "VEC3", 3, three);
    unordered.root["animations"][0]["samplers"][0]["input"] = unordered.addFloats("SCALAR", 1, {1, 3, 2});
    EXPECT_EQ(refusal(unordered),
              "animation 'translation' sampler 0: the times decrease or are not finite at 2");
    AnimatedFile matrix("translation", "LINEAR", "VEC3", 3, three);
    matrix.node()["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_EQ(refusal(matrix),
              "animation 'translation' channel 0: node 0 has a matrix, which cannot be animated");
}

// Writers end one motion and begin the next at the same time: the value jumps there.
TEST(GltfAnimation, KeysAtTheSameTimeJump) {
    AnimatedFile file("translation", "LINEAR", "VEC3", 3, {0, 0, 0, 2, 0, 0, 6, 0, 0, 8, 0, 0});
    file.root["animations"][0]["samplers"][0]["input"] = file.addFloats("SCALAR", 1, {1, 3, 3, 5});
    EXPECT_EQ(file.at(2)[0].x, 1.0f);
    EXPECT_EQ(file.at(3)[0].x, 6.0f);
    EXPECT_EQ(file.at(4)[0].x, 7.0f);
    EXPECT_EQ(file.at(6)[0].x, 8.0f);
}

TEST(GltfAnimation, ChannelsOfExtensionsAreReported) {
    AnimatedFile file("translation", "LINEAR", "VEC3", 3, {5, 0, 0, 5, 0, 0, 5, 0, 0});
    file.root["animations"][0]["channels"][0]["target"] = {{"path", "pointer"}};
    const Scene scene = file.load({.time = 0.0});
    EXPECT_TRUE(scene.warnings.at(0).ends_with("channel 0: path 'pointer' is not animated"));
}

// Target 0 moves the second vertex up. Target 1 moves the first to the left and rotates its normal.
class MorphFile : public TriangleFile {
  public:
    MorphFile() {
        primitive()["attributes"]["NORMAL"] = addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
        primitive()["targets"] = {
            {{"POSITION", addVec3({0, 0, 0, 0, 0, 4, 0, 0, 0})}},
            {{"POSITION", addVec3({-2, 0, 0, 0, 0, 0, 0, 0, 0})},
             {"NORMAL", addVec3({2, 0, 0, 0, 0, 0, 0, 0, 0})}},
        };
    }
};

TEST(GltfMorph, WeightsOfTheNodeBeforeTheMeshs) {
    MorphFile file;
    EXPECT_EQ(file.load().positions, Positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    file.root["meshes"][0]["weights"] = {0.5, 0.25};
    EXPECT_EQ(file.load().positions, Positions({{-0.5f, 0, 0}, {1, 0, 2}, {0, 1, 0}}));
    file.node()["weights"] = {0, 0.5};
    const Scene scene = file.load();
    EXPECT_EQ(scene.positions, Positions({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    expectNear(scene.normals[0], glm::normalize(glm::vec3(1, 0, 1)));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMorph, WeightsAreAnimated) {
    MorphFile file;
    const int input = file.addFloats("SCALAR", 1, {0, 1});
    const int output = file.addFloats("SCALAR", 1, {0, 0, 1, 0.5f}); // two weights per keyframe
    file.root["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
    EXPECT_EQ(file.load({.time = 0.5}).positions, Positions({{-0.5f, 0, 0}, {1, 0, 2}, {0, 1, 0}}));
    file.root["animations"][0]["samplers"][0]["output"] = file.addFloats("SCALAR", 1, {0, 0, 1});
    expectError(ErrorKind::inputRefused, "2 times, but 3 values", [&] { file.load({.time = 0.5}); });
}

TEST(GltfMorph, SparseTargetsMoveAFewVertices) {
    MorphFile file;
    const int indices = file.addView<std::uint8_t>({2});
    const int values = file.addView<float>({0, 0, 6});
    file.primitive()["targets"][0]["POSITION"] =
        file.addAccessor({{"componentType", GltfFile::kFloat},
                          {"count", 3},
                          {"type", "VEC3"},
                          {"sparse",
                           {{"count", 1},
                            {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                            {"values", {{"bufferView", values}}}}}});
    file.node()["weights"] = {0.5, 0};
    EXPECT_EQ(file.load().positions, Positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 3}}));
}

TEST(GltfMorph, TargetOfAnotherSizeIsRefused) {
    MorphFile file;
    file.primitive()["targets"][0]["POSITION"] = file.addVec3({0, 0, 0});
    file.node()["weights"] = {1};
    EXPECT_EQ(file.refusal(),
              "mesh 'body' primitive 0 target 0: POSITION has 1 elements, POSITION of the primitive has 3");
}

// Node 0 has the mesh and is moved, which must not matter. Nodes 1 and 2 are the joints, at x = 1 and x = 2.
class SkinFile : public TriangleFile {
  public:
    SkinFile() {
        root["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {0, 0, 100}}},
                         {{"translation", {1, 0, 0}}, {"children", {2}}},
                         {{"translation", {1, 0, 0}}}};
        root["scenes"][0]["nodes"] = {0, 1};
        root["skins"] = {{{"joints", {1, 2}}}};
        setJoints({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0});
    }

    void setJoints(const std::vector<std::uint8_t>& joints, const std::vector<float>& weights) {
        primitive()["attributes"]["JOINTS_0"] = addAccessor({{"bufferView", addView(joints)},
                                                             {"componentType", kUnsignedByte},
                                                             {"count", joints.size() / 4},
                                                             {"type", "VEC4"}});
        primitive()["attributes"]["WEIGHTS_0"] = addFloats("VEC4", 4, weights);
    }
};

TEST(GltfSkin, VerticesFollowTheirJoints) {
    SkinFile file;
    // Joint 0 moves the first vertex, joint 1 the second, and both move the third.
    EXPECT_EQ(file.load().positions, Positions({{1, 0, 0}, {3, 0, 0}, {1.75f, 1, 0}}));
    EXPECT_EQ(file.load({.scale = 2.0f}).positions, Positions({{2, 0, 0}, {6, 0, 0}, {3.5f, 2, 0}}));
}

TEST(GltfSkin, InverseBindMatricesComeFirst) {
    SkinFile file;
    // The matrices undo the joints' positions in the file, so the mesh stays in place.
    file.root["skins"][0]["inverseBindMatrices"] =
        file.addFloats("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1, //
                                    1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 0, 0, 1});
    EXPECT_EQ(file.load().positions, Positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    // A quarter turn of joint 1 about z, at x = 2, maps (x, y) to (2 - y, x - 2).
    file.root["nodes"][2]["rotation"] = {0, 0, 0.7071067811865476, 0.7071067811865476};
    const Positions turned = file.load().positions;
    expectNear(turned[0], {0, 0, 0});
    expectNear(turned[1], {2, -1, 0});
    expectNear(turned[2], 0.25f * glm::vec3(0, 1, 0) + 0.75f * glm::vec3(1, -2, 0));
}

TEST(GltfSkin, NormalsTurnAndMirrorsKeepTheFront) {
    SkinFile file;
    file.primitive()["attributes"]["NORMAL"] = file.addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.root["nodes"][1]["scale"] = {-1, 1, 1};
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles, std::vector<glm::uvec3>({{0, 2, 1}}));
    EXPECT_EQ(scene.normals[0], glm::vec3(0, 0, 1));
    file.root["nodes"][1].erase("scale");
    file.root["nodes"][1]["rotation"] = {0.7071067811865476, 0, 0, 0.7071067811865476};
    expectNear(file.load().normals[0], {0, -1, 0});
}

TEST(GltfSkin, FurtherSetsOfJoints) {
    SkinFile file;
    file.setJoints(std::vector<std::uint8_t>(12, 0), {0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0});
    Json& attributes = file.primitive()["attributes"];
    attributes["JOINTS_1"] =
        file.addAccessor({{"bufferView", file.addView(std::vector<std::uint16_t>(12, 1))},
                          {"componentType", GltfFile::kUnsignedShort},
                          {"count", 3},
                          {"type", "VEC4"}});
    attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
    EXPECT_EQ(file.load().positions[0], glm::vec3(1.5f, 0, 0));
}

// What has no weight is not drawn, and rounding errors are no reason to refuse a scene.
TEST(GltfSkin, JointsWithoutWeightAndRoundingErrors) {
    SkinFile file;
    file.setJoints({0, 255, 2, 9, 1, 77, 0, 0, 0, 1, 200, 0},
                   {1, 0, 0, -1e-9f, 1, 0, -1e-9f, 0, 0.25f, 0.75f, -0.0f, -1e-4f});
    EXPECT_EQ(file.load().positions, Positions({{1, 0, 0}, {3, 0, 0}, {1.75f, 1, 0}}));
    // Without any weight the first joint counts.
    file.setJoints({1, 255, 2, 9, 1, 77, 0, 0, 0, 1, 200, 0}, {0, 0, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0});
    EXPECT_EQ(file.load().positions[0], glm::vec3(2, 0, 0));
    file.setJoints({0, 255, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, {0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    EXPECT_EQ(file.refusal(), "mesh 'body' primitive 0: joint 255 does not exist, the skin has 2");
}

TEST(GltfSkin, BrokenOnesAreRefused) {
    SkinFile file;
    file.root["skins"][0]["joints"] = {1};
    EXPECT_EQ(file.refusal(), "mesh 'body' primitive 0: joint 1 does not exist, the skin has 1");
    file.root["skins"][0]["joints"] = Json::array();
    EXPECT_EQ(file.refusal(), "skin 0: has no joints");
    file.root["skins"][0]["joints"] = {1, 9};
    EXPECT_EQ(file.refusal(), "skin 0: joint 1: node 9 is not in the scene");
    file.root["skins"][0]["joints"] = {1, 2};
    file.root["scenes"][0]["nodes"] = {0};
    EXPECT_EQ(file.refusal(), "skin 0: joint 0: node 1 is not in the scene");
    file.root["scenes"][0]["nodes"] = {0, 1};
    file.root["skins"][0]["inverseBindMatrices"] =
        file.addFloats("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
    EXPECT_EQ(file.refusal(), "skin 0: 2 joints, but 1 inverse bind matrices");
    file.root["skins"][0].erase("inverseBindMatrices");
    file.setJoints(std::vector<std::uint8_t>(12, 0), {-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    EXPECT_EQ(file.refusal(),
              "mesh 'body' primitive 0: a weight of vertex 0 is -1, not a finite number of at least 0");
    const float infinity = std::numeric_limits<float>::infinity();
    file.setJoints(std::vector<std::uint8_t>(12, 0), {1, 0, 0, 0, 1, infinity, 0, 0, 1, 0, 0, 0});
    EXPECT_EQ(file.refusal(),
              "mesh 'body' primitive 0: a weight of vertex 1 is inf, not a finite number of at least 0");
    file.setJoints(std::vector<std::uint8_t>(12, 0), {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    Json& attributes = file.primitive()["attributes"];
    const Json joints = attributes["JOINTS_0"];
    attributes["JOINTS_0"] = file.addFloats("VEC4", 4, {0, 0, 0, 0, 0, 0, 0, 0, -3, 0, 0, 0});
    EXPECT_EQ(file.refusal(),
              "mesh 'body' primitive 0: a joint of vertex 2 is -3, not an integer from 0 to 65535");
    attributes["JOINTS_0"] = joints;
    file.primitive()["attributes"].erase("WEIGHTS_0");
    EXPECT_EQ(file.refusal(), "mesh 'body' primitive 0: JOINTS_0 without WEIGHTS_0");
    file.primitive()["attributes"].erase("JOINTS_0");
    EXPECT_EQ(file.refusal(), "mesh 'body' primitive 0: has a skin, but no JOINTS_0");
    file.node()["skin"] = 1;
    EXPECT_EQ(file.refusal(), "node 0: skin 1 does not exist, there are 1");
}

} // namespace
} // namespace metamarch
