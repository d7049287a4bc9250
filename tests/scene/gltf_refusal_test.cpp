// SPDX-License-Identifier: MIT
// Hostile and broken glTF: every file is refused with one line that names the element.
#include "scene/gltf_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

namespace metamarch {
namespace {

using Json = nlohmann::json;

void expectRefusal(GltfFile& file, const std::string& line) {
    const std::string found = file.refusal();
    EXPECT_NE(found.find(line), std::string::npos) << found;
}

TEST(GltfRefusal, PositionNotFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        TriangleFile file;
        file.setPositions({0, 0, 0, 1, bad, 0, 0, 1, 0});
        EXPECT_EQ(file.refusal(), "mesh 'body' primitive 0: position of vertex 1 is not finite");
    }
}

TEST(GltfRefusal, PositionThatATransformMakesInfinite) {
    TriangleFile file;
    file.node()["scale"] = {1e300, 1, 1};
    EXPECT_EQ(file.refusal(), "mesh 'body' primitive 0: position of vertex 1 is not finite");
}

TEST(GltfRefusal, IndexOutOfRange) {
    TriangleFile file;
    file.primitive()["indices"] = file.addIndices({0, 1, 3});
    EXPECT_EQ(file.refusal(), "mesh 'body' primitive 0: index 3 is out of range, there are 3 vertices");
}

TEST(GltfRefusal, CountPastTheBufferView) {
    TriangleFile file;
    file.root["accessors"][0]["count"] = 4;
    EXPECT_EQ(file.refusal(),
              "mesh 'body' primitive 0: POSITION: accessor 0: buffer view 0: 4 elements at offset 0 with "
              "stride 12 reach past its 36 bytes");
}

TEST(GltfRefusal, AbsurdNumbers) {
    for (const char* key : {"count", "byteOffset"}) {
        for (const Json& value :
             {Json(-1), Json(std::uint64_t{1} << 52), Json(~std::uint64_t{0}), Json(1.5), Json("3")}) {
            TriangleFile file;
            file.root["accessors"][0][key] = value;
            expectRefusal(
                file, key == std::string("count") && value == Json(std::uint64_t{1} << 52) ? "absurd" : "");
        }
    }
    TriangleFile file;
    file.root["accessors"][0]["count"] = -1;
    EXPECT_EQ(file.refusal(), "accessors[0].count: -1 is not an integer from 0 to 9007199254740992");
}

TEST(GltfRefusal, IndicesOfElementsOutOfRange) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"/scenes/0/nodes/0", "scene: node 9 does not exist, there are 1"},
        {"/nodes/0/mesh", "node 0: mesh 9 does not exist, there are 1"},
        {"/nodes/0/camera", "node 0: camera 9 does not exist, there are 0"},
        {"/meshes/0/primitives/0/material",
         "mesh 'body' primitive 0: material 9 does not exist, there are 0"},
        {"/meshes/0/primitives/0/mode", "mesh 'body' primitive 0: mode 9 is not one of glTF 2.0"},
        {"/meshes/0/primitives/0/attributes/POSITION", "POSITION: accessor 9 does not exist"},
        {"/accessors/0/bufferView", "accessor 0: buffer view 9 does not exist, there are 1"},
        {"/bufferViews/0/buffer", "buffer view 0: buffer 9 does not exist, there are 1"},
        {"/scene", "scene 9 does not exist, there are 1"},
    };
    for (const auto& [pointer, line] : cases) {
        TriangleFile file;
        file.root[Json::json_pointer(pointer)] = 9;
        expectRefusal(file, line);
        // tinygltf truncates to 32 bits, which would make a valid 0 of 2^32.
        file.root[Json::json_pointer(pointer)] = std::uint64_t{1} << 32;
        expectRefusal(file, "4294967296 is not an integer from 0 to 2147483647");
    }
}

TEST(GltfRefusal, BufferViewPastTheBuffer) {
    for (const std::uint64_t offset : {std::uint64_t{1}, std::uint64_t{1} << 40}) {
        TriangleFile file;
        file.root["bufferViews"][0]["byteOffset"] = offset;
        expectRefusal(file, "buffer view 0 reaches past the end of buffer 0");
    }
}

TEST(GltfRefusal, StrideSmallerThanAnElement) {
    TriangleFile file;
    file.root["bufferViews"][0]["byteStride"] = 4;
    expectRefusal(file, "accessor 0: buffer view 0: stride 4 is less than an element of 12 bytes");
}

TEST(GltfRefusal, AccessorOfTheWrongType) {
    TriangleFile file;
    file.root["accessors"][0]["type"] = "VEC2";
    expectRefusal(file, "POSITION: accessor 0: has elements of the wrong type");
}

TEST(GltfRefusal, ComponentTypeOfOtherGltf) {
    TriangleFile file;
    file.root["accessors"][0]["componentType"] = 5130; // double
    expectRefusal(file, "accessor 0: component type 5130 is not one of glTF 2.0");
}

TEST(GltfRefusal, SparseOutOfRangeOrOrder) {
    const auto refusal = [](const std::vector<std::uint16_t>& indices, int count) {
        TriangleFile file;
        const int indexView = file.addView(indices);
        const int valueView = file.addView<float>({7, 8, 9, 4, 5, 6});
        file.root["accessors"][0]["sparse"] = {
            {"count", count},
            {"indices", {{"bufferView", indexView}, {"componentType", 5123}}},
            {"values", {{"bufferView", valueView}}}};
        return file.refusal();
    };
    EXPECT_TRUE(refusal({0, 3}, 2).ends_with("accessor 0: sparse index 3 is out of range, the count is 3"));
    EXPECT_TRUE(refusal({1, 1}, 2).ends_with("accessor 0: sparse indices do not increase at 1"));
    EXPECT_TRUE(refusal({0, 1}, 4).ends_with("accessor 0: sparse count 4 is more than its count 3"));
    EXPECT_TRUE(refusal({0, 1}, 3).ends_with("reach past its 4 bytes"));
}

TEST(GltfRefusal, ZerosWithoutEnd) {
    TriangleFile file;
    file.root["accessors"][0].erase("bufferView");
    expectRefusal(file, "POSITION: accessor 0: has no data");
}

TEST(GltfRefusal, CountsOfAttributesDiffer) {
    TriangleFile file;
    file.primitive()["attributes"]["NORMAL"] = file.addVec3({0, 0, 1});
    EXPECT_EQ(file.refusal(),
              "mesh 'body' primitive 0: NORMAL has 1 elements, POSITION of the primitive has 3");
}

TEST(GltfRefusal, NodeCycleAndTwoParents) {
    TriangleFile file;
    file.node()["children"] = {0};
    expectRefusal(file, "node 0 is reached twice");
    file.root["nodes"] = {{{"children", {1, 2}}}, {{"children", {2}}}, {{"name", "leaf"}}};
    expectRefusal(file, "node 'leaf' is reached twice");
    file.root["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
    file.root.erase("scenes");
    expectRefusal(file, "no node is without a parent");
}

TEST(GltfRefusal, TransformOfWrongLength) {
    TriangleFile file;
    file.node()["matrix"] = {1, 2, 3};
    EXPECT_EQ(file.refusal(), "node 0: matrix has 3 numbers, not 16");
}

TEST(GltfRefusal, UriLeavesTheFolder) {
    for (const char* uri :
         {"../scene.bin", "%2e%2e/scene.bin", "a/../../scene.bin", "/etc/passwd", "%2Fetc/passwd"}) {
        TriangleFile file;
        file.root["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        expectRefusal(file, "leaves the scene's folder");
    }
    TriangleFile file;
    std::filesystem::create_symlink("/etc/passwd", file.folder / "link.bin");
    file.root["buffers"] = {{{"uri", "link.bin"}, {"byteLength", 36}}};
    EXPECT_EQ(file.refusal(), "buffer 0: 'link.bin' leaves the scene's folder");
}

TEST(GltfRefusal, BufferMissingOrElsewhere) {
    TriangleFile file;
    file.root["buffers"] = {{{"uri", "other.bin"}, {"byteLength", 36}}};
    EXPECT_EQ(file.refusal(), "buffer 0: 'other.bin' is missing");
    file.root["buffers"] = {{{"uri", "https://example.org/a.bin"}, {"byteLength", 36}}};
    EXPECT_EQ(file.refusal(), "buffer 0: 'https://example.org/a.bin' is not a file beside the scene");
    file.root["buffers"] = {{{"uri", "data:text/plain,abc"}, {"byteLength", 3}}};
    EXPECT_EQ(file.refusal(), "buffer 0: a data URI that is not base64");
}

TEST(GltfRefusal, RequiredExtension) {
    TriangleFile file;
    file.root["extensionsUsed"] = {"ACME_paint", "KHR_materials_clearcoat", "ACME_wobble"};
    const Scene scene = file.load();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with("extensionsUsed: ignoring ACME_paint, ACME_wobble"));
    for (const char* name : {"ACME_wobble", "KHR_materials_wobble", ""}) {
        file.root["extensionsRequired"] = {"KHR_texture_transform", name};
        EXPECT_EQ(file.refusal(), "extensionsRequired: " + std::string(name) + " is not supported");
    }
}

// Names and values may be whole payloads.
TEST(GltfRefusal, QuotesAreCut) {
    const std::string letters(5000, 'x');
    const std::string cut = std::string(80, 'x') + "...";
    TriangleFile file;
    file.root["buffers"] = {{{"uri", letters}, {"byteLength", 36}}};
    EXPECT_EQ(file.refusal(), "buffer 0: '" + cut + "' has too long a name");
    file.root["buffers"][0]["uri"] = "data:application/octet-stream," + letters;
    EXPECT_EQ(file.refusal(), "buffer 0: a data URI that is not base64");
    file.root["buffers"][0]["uri"] = "data:application/octet-stream;base64,!" + letters;
    EXPECT_LT(file.refusal().size(), 200u);
    file.root.erase("buffers");
    file.root["materials"] = {{{"alphaMode", letters}}};
    EXPECT_EQ(file.refusal(), "material 0: alphaMode '" + cut + "' is none of OPAQUE, MASK, BLEND");
    std::string words;
    for (int i = 0; i < 1000; ++i) {
        words += "word ";
    }
    file.root["materials"][0]["alphaMode"] = words;
    EXPECT_EQ(file.refusal(),
              "material 0: alphaMode '" + words.substr(0, 80) + "...' is none of OPAQUE, MASK, BLEND");
    file.root["materials"] = {{{"alphaCutoff", Json::array()}}};
    file.root["materials"][0]["alphaCutoff"] = std::vector<int>(5000, 1);
    EXPECT_LT(file.refusal().size(), 200u);
    // A cut does not fall into a character.
    file.root["materials"] = {{{"alphaMode", std::string(79, 'x') + "äöü"}}};
    EXPECT_EQ(file.refusal(),
              "material 0: alphaMode '" + std::string(79, 'x') + "...' is none of OPAQUE, MASK, BLEND");
    const std::filesystem::path path = file.folder / "prose.gltf";
    writeFile(path, "{\"asset\": " + letters);
    EXPECT_LT(refusalOf(path).size(), 400u);
}

TEST(GltfRefusal, VersionsAsNumbers) {
    for (const Json& version : {Json(2), Json(2.0)}) {
        TriangleFile file;
        file.root["asset"]["version"] = version;
        const Scene scene = file.load();
        EXPECT_EQ(scene.triangles.size(), 1u);
        ASSERT_EQ(scene.warnings.size(), 1u);
        EXPECT_TRUE(scene.warnings[0].ends_with("asset.version: the number " + version.dump() +
                                                " is taken for the text \"2.0\""));
    }
    TriangleFile file;
    file.root["asset"]["version"] = 1;
    EXPECT_EQ(file.refusal(), "asset.version: glTF 1.0 is not supported, glTF 2.0 is");
    file.root["asset"]["version"] = Json::array();
    EXPECT_EQ(file.refusal(), "asset.version: [] is not a version of glTF such as \"2.0\"");
    file.root["asset"] = Json::object();
    EXPECT_EQ(file.refusal(), "asset.version is missing");
}

TEST(GltfRefusal, JsonTooDeep) {
    TriangleFile file;
    file.write();
    const std::string text = file.root.dump();
    writeFile(file.folder / "deep.gltf",
              text.substr(0, text.size() - 1) + ",\"extensions\":" + std::string(100000, '['));
    EXPECT_EQ(refusalOf(file.folder / "deep.gltf"), "JSON is nested more than 64 deep");
}

TEST(GltfRefusal, NotGltf) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusalOf(folder / "none.glb"), "no such file");
    EXPECT_EQ(refusalOf(folder / "."), "not a regular file");
    writeFile(folder / "empty.gltf", "");
    EXPECT_EQ(refusalOf(folder / "empty.gltf"), "the file is empty");
    writeFile(folder / "scene.xyz", "x");
    EXPECT_EQ(refusalOf(folder / "scene.xyz"), "the ending '.xyz' is none of .gltf .glb .obj .ply .off .stl");
    writeFile(folder / "prose.gltf", "Dear friend,\nthis is a letter.");
    EXPECT_TRUE(refusalOf(folder / "prose.gltf").starts_with("not glTF: parse error at line 1, column 1: "));
    writeFile(folder / "old.gltf", R"({"asset":{"version":"1.0"}})");
    EXPECT_EQ(refusalOf(folder / "old.gltf"), "asset.version: glTF 1.0 is not supported, glTF 2.0 is");
    writeFile(folder / "list.gltf", R"({"asset":{"version":"2.0"},"meshes":{"a":1}})");
    EXPECT_EQ(refusalOf(folder / "list.gltf"), "meshes is not an array of objects");
    for (const char* primitives : {R"({"a":1})", "[1]", "3"}) {
        writeFile(
            folder / "primitives.gltf",
            fmt::format(R"({{"asset":{{"version":"2.0"}},"meshes":[{{"primitives":{}}}]}})", primitives));
        EXPECT_EQ(refusalOf(folder / "primitives.gltf"), "meshes[0].primitives is not an array of objects");
    }
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        for (const char* names : {R"("KHR_lights_punctual")", "[1]", "{}"}) {
            writeFile(folder / "names.gltf",
                      fmt::format(R"({{"asset":{{"version":"2.0"}},"{}":{}}})", key, names));
            EXPECT_EQ(refusalOf(folder / "names.gltf"), key + std::string(" is not an array of strings"));
        }
    }
}

// The lengths of a GLB's header and chunks, with one of them wrong at a time.
TEST(GltfRefusal, GlbLengths) {
    const TemporaryFolder folder;
    const std::string json = R"({"asset":{"version":"2.0"}} )";
    const auto glb = [&](std::uint32_t version, std::uint32_t length, std::uint32_t jsonLength) {
        const std::vector<std::uint32_t> words = {0x46546c67, version, length, jsonLength, 0x4e4f534a};
        writeFile(folder / "a.glb", std::string(reinterpret_cast<const char*>(words.data()), 20) + json);
        return folder / "a.glb";
    };
    const auto jsonLength = static_cast<std::uint32_t>(json.size());
    EXPECT_EQ(loadScene(glb(2, 20 + jsonLength, jsonLength)).triangles.size(), 0u);
    EXPECT_EQ(refusalOf(glb(1, 20 + jsonLength, jsonLength)), "GLB version 1 is not supported, version 2 is");
    EXPECT_EQ(refusalOf(glb(2, 1000, jsonLength)), "GLB length 1000 is more than the file's 48 bytes");
    EXPECT_EQ(refusalOf(glb(2, 19, jsonLength)), "GLB length 19 leaves no room for a chunk");
    EXPECT_EQ(refusalOf(glb(2, 20 + jsonLength, 0xfffffffc)),
              "GLB chunk 0 of 4294967292 bytes reaches past the GLB length 48");
    EXPECT_EQ(refusalOf(glb(2, 20 + jsonLength, jsonLength - 4)), "GLB chunk 1 header is cut off");
    writeFile(folder / "a.glb", "glTF");
    EXPECT_EQ(refusalOf(folder / "a.glb"), "GLB header is cut off");
}

} // namespace
} // namespace metamarch
