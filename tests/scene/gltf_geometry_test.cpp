// SPDX-License-Identifier: MIT
// How valid glTF geometry is imported, number by number.
#include "fixtures/expect_error.h"
#include "metamarch/error/error.h"
#include "scene/gltf_file.h"
#include "scene/picture_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>

namespace metamarch {
namespace {

using Json = nlohmann::json;
using Triangles = std::vector<glm::uvec3>;

const std::vector<float> kFivePoints = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

glm::vec3 front(const Scene& scene, std::size_t triangle) {
    const glm::uvec3 corner = scene.triangles[triangle];
    return glm::cross(scene.positions[corner.y] - scene.positions[corner.x],
                      scene.positions[corner.z] - scene.positions[corner.x]);
}

TEST(GltfGeometry, TrianglesWithoutIndices) {
    TriangleFile file;
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles, Triangles({{0, 1, 2}}));
    EXPECT_EQ(scene.positions, std::vector<glm::vec3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.normals, std::vector<glm::vec3>(3, glm::vec3(0)));
    EXPECT_EQ(scene.texCoords, std::vector<glm::vec2>(3, glm::vec2(0)));
    EXPECT_EQ(scene.triangleMesh, std::vector<std::uint32_t>({0}));
    EXPECT_EQ(scene.triangleMaterial, std::vector<std::uint32_t>({0}));
    EXPECT_EQ(scene.materials.size(), 1u); // the default material
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].name, "body");
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfGeometry, VerticesThatNoTriangleUsesMayBeBroken) {
    GltfFile file;
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    file.setPositions({0, 0, 0, kNan, 0, 0, 1, 0, 0, 0, 1, 0, 0, kNan, 0});
    file.primitive()["indices"] = file.addIndices({0, 2, 3});
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles, Triangles({{0, 2, 3}}));
    EXPECT_EQ(scene.positions[1], glm::vec3(0));
    EXPECT_EQ(scene.positions[4], glm::vec3(0));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with(
        "mesh 'body': 2 positions of vertices that no triangle uses are not finite; zero is used"));
    file.primitive()["indices"] = file.addIndices({0, 2, 4});
    EXPECT_EQ(file.refusal(), "mesh 'body' primitive 0: position of vertex 4 is not finite");
}

TEST(GltfGeometry, StripTurnsEveryOtherTriangle) {
    GltfFile file;
    file.setPositions(kFivePoints);
    file.primitive()["mode"] = 5;
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles, Triangles({{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GT(front(scene, i).z, 0.0f);
    }
}

TEST(GltfGeometry, IndexedFan) {
    GltfFile file;
    file.setPositions(kFivePoints);
    file.primitive()["mode"] = 6;
    file.primitive()["indices"] = file.addIndices({0, 1, 3, 4, 2});
    EXPECT_EQ(file.load().triangles, Triangles({{1, 3, 0}, {3, 4, 0}, {4, 2, 0}}));
}

TEST(GltfGeometry, PointsAndLinesAreReported) {
    for (int mode = 0; mode < 4; ++mode) {
        TriangleFile file;
        file.primitive()["mode"] = mode;
        const Scene scene = file.load();
        EXPECT_TRUE(scene.triangles.empty());
        EXPECT_TRUE(scene.positions.empty());
        ASSERT_EQ(scene.warnings.size(), 1u);
        EXPECT_TRUE(
            scene.warnings[0].ends_with("mesh 'body' primitive 0: points and lines are not rendered"));
    }
}

TEST(GltfGeometry, CornersThatMakeNoTriangleAreReported) {
    GltfFile file;
    file.setPositions(kFivePoints);
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles, Triangles({{0, 1, 2}}));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with("primitive 0: 5 corners are no whole number of triangles"));
}

TEST(GltfGeometry, SparseReplacesElements) {
    TriangleFile file;
    const int indices = file.addView<std::uint8_t>({0, 2});
    const int values = file.addView<float>({7, 8, 9, 4, 5, 6});
    file.root["accessors"][0]["sparse"] = {{"count", 2},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", values}}}};
    EXPECT_EQ(file.load().positions, std::vector<glm::vec3>({{7, 8, 9}, {1, 0, 0}, {4, 5, 6}}));
}

TEST(GltfGeometry, SparseWithoutBufferViewReplacesZeros) {
    TriangleFile file;
    const int indices = file.addView<std::uint32_t>({1});
    const int values = file.addView<float>({4, 5, 6});
    file.root["accessors"][0].erase("bufferView");
    file.root["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5125}}},
                                           {"values", {{"bufferView", values}}}};
    EXPECT_EQ(file.load().positions, std::vector<glm::vec3>({{0, 0, 0}, {4, 5, 6}, {0, 0, 0}}));
}

TEST(GltfGeometry, InterleavedByStride) {
    GltfFile file;
    // Each vertex: position, normal (of length 2), texture coordinate.
    const int view = file.addView<float>(
        {0, 0, 0, 0, 0, 2, 0.25f, 0.5f, 1, 0, 0, 0, 0, 2, 0.5f, 0.5f, 0, 1, 0, 0, 0, 2, 0.75f, 1.0f});
    file.root["bufferViews"][0]["byteStride"] = 32;
    const auto attribute = [&](const char* type, int offset) {
        return file.addAccessor({{"bufferView", view},
                                 {"byteOffset", offset},
                                 {"componentType", 5126},
                                 {"count", 3},
                                 {"type", type}});
    };
    file.primitive()["attributes"] = {{"POSITION", attribute("VEC3", 0)},
                                      {"NORMAL", attribute("VEC3", 12)},
                                      {"TEXCOORD_0", attribute("VEC2", 24)}};
    const Scene scene = file.load();
    EXPECT_EQ(scene.positions, std::vector<glm::vec3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.normals, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    EXPECT_EQ(scene.texCoords, std::vector<glm::vec2>({{0.25f, 0.5f}, {0.5f, 0.5f}, {0.75f, 1.0f}}));
}

// glTF 2.0 allows strides up to 252 in steps of 4. Others can be read as well.
TEST(GltfGeometry, StridesThatGltfDoesNotAllow) {
    for (const std::size_t stride : {13u, 300u}) {
        GltfFile file;
        std::vector<unsigned char> bytes(2 * stride + 12);
        const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        for (std::size_t i = 0; i < 3; ++i) {
            std::memcpy(&bytes[i * stride], corners[i], 12);
        }
        const int view = file.addView(bytes);
        file.root["bufferViews"][0]["byteStride"] = stride;
        file.primitive()["attributes"]["POSITION"] =
            file.addAccessor({{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
        EXPECT_EQ(file.load().positions, std::vector<glm::vec3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    }
}

// glTF 2.0, 3.6.1.1: a buffer has at least byteLength bytes.
TEST(GltfGeometry, BuffersLongerThanTheirByteLength) {
    TriangleFile file;
    file.write();
    file.root["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", 36}}};
    std::ofstream(file.folder / "scene.bin", std::ios::app) << "and more";
    writeFile(file.folder / "file.gltf", file.root.dump());
    std::ifstream stream(file.folder / "scene.bin", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    file.root["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes);
    writeFile(file.folder / "data.gltf", file.root.dump());
    for (const char* name : {"file.gltf", "data.gltf"}) {
        const Scene scene = loadScene(file.folder / name);
        EXPECT_EQ(scene.positions, std::vector<glm::vec3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
        EXPECT_TRUE(scene.warnings.empty());
    }
}

// What is not there matters only to what refers to it.
TEST(GltfGeometry, BufferShorterThanItsByteLength) {
    TriangleFile file;
    file.root["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", 40}}};
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with("buffer 0: its byteLength is 40, but only 36 bytes are there"));
    file.root["bufferViews"][0]["byteLength"] = 40;
    EXPECT_EQ(file.refusal(),
              "mesh 'body' primitive 0: POSITION: accessor 0: buffer view 0 reaches past the end of "
              "buffer 0 (offset 0, length 40, buffer 36 bytes)");
}

// A file that thousands of buffers name is read and kept once.
TEST(GltfGeometry, BuffersOfTheSameFile) {
    TriangleFile file;
    for (int i = 0; i < 5000; ++i) {
        const std::string uri = i % 2 == 0 ? "scene.bin" : "./scene.bin";
        file.root["buffers"].push_back({{"uri", uri}, {"byteLength", 36}});
    }
    file.root["bufferViews"][0]["buffer"] = 4999;
    const std::filesystem::path path = file.write();
    std::ofstream(file.folder / "scene.bin", std::ios::app) << std::string(1 << 20, ' ');
    EXPECT_EQ(loadScene(path).positions, std::vector<glm::vec3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

template <typename T>
std::vector<glm::vec3> quantizedPositions(int componentType, bool normalized) {
    constexpr T kMost = std::numeric_limits<T>::max();
    constexpr T kLeast = std::numeric_limits<T>::min();
    GltfFile file;
    const int view = file.addView<T>({0, 0, 0, kMost, 0, kLeast, 0, kMost, 0});
    const int accessor = file.addAccessor({{"bufferView", view},
                                           {"componentType", componentType},
                                           {"normalized", normalized},
                                           {"count", 3},
                                           {"type", "VEC3"}});
    file.primitive()["attributes"]["POSITION"] = accessor;
    file.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    return file.load().positions;
}

TEST(GltfGeometry, QuantizedPositions) {
    using Positions = std::vector<glm::vec3>;
    EXPECT_EQ(quantizedPositions<std::int8_t>(5120, true), Positions({{0, 0, 0}, {1, 0, -1}, {0, 1, 0}}));
    EXPECT_EQ(quantizedPositions<std::uint8_t>(5121, true), Positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(quantizedPositions<std::int16_t>(5122, true), Positions({{0, 0, 0}, {1, 0, -1}, {0, 1, 0}}));
    EXPECT_EQ(quantizedPositions<std::uint16_t>(5123, true), Positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(quantizedPositions<std::int8_t>(5120, false),
              Positions({{0, 0, 0}, {127, 0, -128}, {0, 127, 0}}));
    EXPECT_EQ(quantizedPositions<std::uint16_t>(5123, false),
              Positions({{0, 0, 0}, {65535, 0, 0}, {0, 65535, 0}}));
}

TEST(GltfGeometry, ColorsOfThreeAndFourChannels) {
    TriangleFile file;
    EXPECT_TRUE(file.load().colors.empty());
    nlohmann::json& color = file.primitive()["attributes"]["COLOR_0"];
    color = file.addVec3({0.5f, 0, 1, 0, 0.25f, 0, 2, 2, 2});
    EXPECT_EQ(file.load().colors, std::vector<glm::vec4>({{0.5f, 0, 1, 1}, {0, 0.25f, 0, 1}, {2, 2, 2, 1}}));
    color = file.addFloats("VEC4", 4, {0.5f, 0, 1, 0.5f, 0, 0.25f, 0, 0, 2, 2, 2, 1});
    EXPECT_EQ(file.load().colors[0], glm::vec4(0.5f, 0, 1, 0.5f));
    const int view = file.addView<std::uint8_t>({255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 0});
    color = file.addAccessor({{"bufferView", view},
                              {"componentType", GltfFile::kUnsignedByte},
                              {"normalized", true},
                              {"count", 3},
                              {"type", "VEC4"}});
    EXPECT_EQ(file.load().colors[0], glm::vec4(1, 0, 0.2f, 0.4f));
    color = file.addVec3({-0.5f, 0, 1, 0, 0.25f, 0, 2, 2, 2});
    const Scene scene = file.load();
    EXPECT_EQ(scene.colors[0], glm::vec4(1));
    EXPECT_TRUE(scene.warnings.at(0).ends_with("1 colours are negative or not finite; white is used"));
}

TEST(GltfGeometry, HierarchyOfTransforms) {
    TriangleFile file;
    // First 90 degrees about z, then scaled by 2 and moved to (10, 0, 0).
    file.root["nodes"] = {{{"children", {1}}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1}}},
                          {{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}};
    EXPECT_EQ(file.load({.scale = 0.5f}).positions,
              std::vector<glm::vec3>({{5, 0, 0}, {5, 1, 0}, {4, 0, 0}}));
}

TEST(GltfGeometry, MirrorKeepsTheFront) {
    TriangleFile file;
    file.primitive()["attributes"]["NORMAL"] = file.addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.node()["scale"] = {-1, 1, 1};
    const Scene scene = file.load();
    EXPECT_EQ(scene.positions[1], glm::vec3(-1, 0, 0));
    EXPECT_EQ(scene.triangles, Triangles({{0, 2, 1}}));
    EXPECT_GT(front(scene, 0).z, 0.0f);
    EXPECT_EQ(scene.normals[0], glm::vec3(0, 0, 1));
}

TEST(GltfGeometry, NonUniformScaleTiltsNormals) {
    TriangleFile file;
    file.primitive()["attributes"]["NORMAL"] = file.addVec3({1, 1, 0, 1, 1, 0, 1, 1, 0});
    file.node()["scale"] = {1, 2, 1};
    const glm::vec3 normal = file.load().normals[0];
    EXPECT_FLOAT_EQ(normal.x, 2.0f / std::sqrt(5.0f));
    EXPECT_FLOAT_EQ(normal.y, 1.0f / std::sqrt(5.0f));
}

TEST(GltfGeometry, SingularMatrixFlattens) {
    TriangleFile file;
    file.primitive()["attributes"]["NORMAL"] = file.addVec3({0, 0, 1, 1, 0, 0, 0, 0, 1});
    file.node()["scale"] = {1, 1, 0};
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.normals[1], glm::vec3(0)); // the transform maps it to zero
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfGeometry, BrokenNormalsAreLeftOutWithOneLine) {
    TriangleFile file;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    file.primitive()["attributes"]["NORMAL"] = file.addVec3({0, 0, 0, nan, 0, 1, 0, 0, 3});
    file.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}}};
    file.root["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = file.load();
    EXPECT_EQ(scene.normals[0], glm::vec3(0));
    EXPECT_EQ(scene.normals[1], glm::vec3(0));
    EXPECT_EQ(scene.normals[2], glm::vec3(0, 0, 1));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("mesh 'body': 2 normals are zero or not finite"), std::string::npos);
}

TEST(GltfGeometry, InstancesBecomeMeshes) {
    TriangleFile file;
    file.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}};
    file.root["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.triangleMesh, std::vector<std::uint32_t>({0, 1}));
    EXPECT_EQ(scene.triangles, Triangles({{0, 1, 2}, {3, 4, 5}}));
    EXPECT_EQ(scene.positions[3], glm::vec3(0, 0, 5));
}

TEST(GltfGeometry, GpuInstancing) {
    TriangleFile file;
    const int translation = file.addVec3({1, 0, 0, 0, 2, 0});
    const int scale = file.addVec3({1, 1, 1, 3, 3, 3});
    file.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", translation},
                                                                          {"SCALE", scale}};
    file.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.positions[1], glm::vec3(2, 0, 0));
    EXPECT_EQ(scene.positions[4], glm::vec3(3, 2, 0));
}

TEST(GltfGeometry, DefaultScene) {
    TriangleFile file;
    file.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 1}}}};
    file.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    file.root["scene"] = 1;
    EXPECT_EQ(file.load().positions[0].z, 1.0f);
    file.root.erase("scene");
    EXPECT_EQ(file.load().positions[0].z, 0.0f);
    EXPECT_EQ(file.load().scenes, std::vector<std::string>({"", ""}));
    file.root.erase("scenes"); // selects all root nodes
    EXPECT_EQ(file.load().meshes.size(), 2u);
    EXPECT_TRUE(file.load().scenes.empty());
}

TEST(GltfGeometry, SceneByNameOrIndex) {
    TriangleFile file;
    file.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 1}}}};
    file.root["scenes"] = {{{"name", "near"}, {"nodes", {1}}}, {{"name", "far"}, {"nodes", {0}}}};
    EXPECT_EQ(file.load({.scene = "far"}).positions[0].z, 0.0f);
    EXPECT_EQ(file.load({.scene = "far"}).scenes, std::vector<std::string>({"near", "far"}));
    EXPECT_EQ(file.load({.scene = "0"}).positions[0].z, 1.0f);
    expectError(ErrorKind::invalidArgument, "there is no scene wide; the file has 0 'near', 1 'far'",
                {"scene"}, [&] { file.load({.scene = "wide"}); });
    const std::filesystem::path mesh = file.folder / "a.obj";
    writeFile(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(loadScene(mesh, {.scene = "0"}).triangles.size(), 1u);
    expectError(ErrorKind::invalidArgument, "there is no scene 1", {"scene"},
                [&] { loadScene(mesh, {.scene = "1"}); });
}

// KHR_node_visibility: a hidden node hides what is below it, but no camera, and it still moves joints.
TEST(GltfGeometry, HiddenNodes) {
    TriangleFile file;
    const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
    const Json shown = {{"KHR_node_visibility", {{"visible", true}}}};
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    file.root["nodes"] = {
        {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", Json::object()}}}},
        {{"extensions", hidden}, {"children", {2}}},
        {{"mesh", 0},
         {"camera", 0},
         {"extensions",
          {{"KHR_node_visibility", {{"visible", true}}}, {"KHR_lights_punctual", {{"light", 0}}}}}},
    };
    file.root["scenes"][0]["nodes"] = {0, 1};
    file.root["extensionsRequired"] = {"KHR_node_visibility"};
    Scene scene = file.load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.lights.size(), 0u);
    EXPECT_EQ(scene.cameras.size(), 1u);
    file.root["nodes"][1]["extensions"] = shown;
    scene = file.load();
    EXPECT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.lights.size(), 1u);
    file.root["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = 0;
    EXPECT_EQ(file.refusal(), "node 1: KHR_node_visibility: visible is neither true nor false");
}

TEST(GltfGeometry, EmptySceneIsAScene) {
    GltfFile file;
    file.root = {{"asset", {{"version", "2.0"}}}};
    const Scene scene = file.load();
    EXPECT_TRUE(scene.triangles.empty());
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfGeometry, HierarchyAsDeepAsItLikes) {
    TriangleFile file;
    constexpr int kDepth = 20000;
    Json nodes = Json::array();
    for (int i = 0; i < kDepth; ++i) {
        nodes.push_back({{"children", {i + 1}}, {"translation", {0, 0, 1}}});
    }
    nodes.push_back({{"mesh", 0}});
    file.root["nodes"] = nodes;
    EXPECT_EQ(file.load().positions[0].z, static_cast<float>(kDepth));
}

TEST(GltfGeometry, BackslashesInTheNameOfABuffer) {
    TriangleFile file;
    const std::filesystem::path path = file.write();
    std::filesystem::create_directory(file.folder / "data");
    std::filesystem::rename(file.folder / "scene.bin", file.folder / "data/scene.bin");
    file.root["buffers"] = {{{"uri", "data\\scene.bin"}, {"byteLength", 36}}};
    writeFile(path, file.root.dump());
    EXPECT_EQ(loadScene(path).triangles.size(), 1u);
    file.root["buffers"][0]["uri"] = "..\\scene.bin";
    writeFile(path, file.root.dump());
    EXPECT_EQ(refusalOf(path), "buffer 0: '../scene.bin' leaves the scene's folder");
}

TEST(GltfGeometry, NamesWithSpacesEscapesAndUnicode) {
    for (const char* uri : {"my buffer+1%.bin", "my%20buffer+1%25.bin"}) {
        TriangleFile file;
        const std::filesystem::path path = file.write("ünï ❤.gltf");
        std::filesystem::rename(file.folder / "scene.bin", file.folder / "my buffer+1%.bin");
        file.root["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        writeFile(path, file.root.dump());
        EXPECT_EQ(loadScene(path).triangles.size(), 1u);
    }
}

} // namespace
} // namespace metamarch
