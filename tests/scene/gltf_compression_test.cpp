// SPDX-License-Identifier: MIT
// Draco and meshopt: decoding restores what was encoded, and hostile bytes are refused.
#include "metamarch/error/error.h"
#include "scene/gltf_file.h"

#include <gtest/gtest.h>

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#ifdef METAMARCH_MESHOPT
#include <meshoptimizer.h>
#endif

namespace metamarch {
namespace {

using Json = nlohmann::json;
using Positions = std::vector<glm::vec3>;
using Triangles = std::vector<glm::uvec3>;

const Positions kPositions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}};
const std::vector<std::uint8_t> kColors = {255, 0, 0, 0, 255, 0, 0, 0, 255, 51, 51, 51};

template <class T>
int addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType dataType,
                 const T* values) {
    draco::PointAttribute attribute;
    attribute.Init(type, 3, dataType, false, mesh.num_points());
    attribute.SetIdentityMapping();
    for (draco::AttributeValueIndex i(0); i < mesh.num_points(); ++i) {
        attribute.SetAttributeValue(i, values + 3 * i.value());
    }
    return mesh.AddAttribute(std::make_unique<draco::PointAttribute>(std::move(attribute)));
}

// Returns two triangles without loss: sequential encoding and no quantisation.
std::vector<char> dracoBytes(int& positionId, int& colorId) {
    draco::Mesh mesh;
    mesh.set_num_points(4);
    const int position =
        addAttribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, &kPositions[0].x);
    const int color = addAttribute(mesh, draco::GeometryAttribute::COLOR, draco::DT_UINT8, kColors.data());
    positionId = static_cast<int>(mesh.attribute(position)->unique_id());
    colorId = static_cast<int>(mesh.attribute(color)->unique_id());
    mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
    mesh.AddFace({draco::PointIndex(0), draco::PointIndex(2), draco::PointIndex(3)});
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

class DracoFile : public GltfFile {
  public:
    DracoFile() {
        int positionId = 0;
        int colorId = 0;
        bytes = dracoBytes(positionId, colorId);
        primitive()["attributes"] = {
            {"POSITION", addAccessor({{"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}})},
            {"COLOR_0",
             addAccessor(
                 {{"componentType", kUnsignedByte}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}})}};
        primitive()["indices"] =
            addAccessor({{"componentType", kUnsignedShort}, {"count", 6}, {"type", "SCALAR"}});
        extension() = {{"bufferView", addView(bytes)},
                       {"attributes", {{"POSITION", positionId}, {"COLOR_0", colorId}}}};
        root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    }

    Json& extension() { return primitive()["extensions"]["KHR_draco_mesh_compression"]; }

    std::vector<char> bytes;
};

TEST(GltfDraco, DecodesToWhatWasEncoded) {
    DracoFile file;
    const Scene scene = file.load();
    EXPECT_EQ(scene.positions, kPositions);
    EXPECT_EQ(scene.triangles, Triangles({{0, 1, 2}, {0, 2, 3}}));
    ASSERT_EQ(scene.colors.size(), 4u);
    EXPECT_EQ(scene.colors[1], glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(scene.colors[3], glm::vec4(0.2f, 0.2f, 0.2f, 1));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfDraco, MeshOfTwoNodesAndPlainNeighbours) {
    DracoFile file;
    file.root["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", file.addVec3({0, 0, 9, 1, 0, 9, 0, 1, 9})}}}});
    file.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}}};
    file.root["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles.size(), 6u);
    EXPECT_EQ(scene.positions[4].z, 9.0f);
}

TEST(GltfDraco, WhatDoesNotFitIsRefused) {
    DracoFile file;
    const std::string label = "mesh 'body' primitive 0: KHR_draco_mesh_compression: ";
    file.extension()["attributes"]["POSITION"] = 77;
    EXPECT_EQ(file.refusal(), label + "POSITION: there is no attribute 77");
    file.extension()["attributes"]["POSITION"] = -1;
    EXPECT_NE(file.refusal().find("POSITION: -1 is not an integer"), std::string::npos);
    DracoFile typed;
    typed.root["accessors"][0]["type"] = "VEC2";
    EXPECT_EQ(typed.refusal(), label + "POSITION: accessor 0 has another type");
    DracoFile far;
    far.primitive()["attributes"]["POSITION"] = 9;
    EXPECT_EQ(far.refusal(), label + "POSITION: accessor 9 does not exist, there are 3");
    DracoFile view;
    view.extension()["bufferView"] = 9;
    EXPECT_EQ(view.refusal(), label + "buffer view 9 does not exist, there are 1");
    view.extension().erase("bufferView");
    EXPECT_EQ(view.refusal(), label + "buffer view -1 does not exist, there are 1");
    // An attribute without compressed data has no data of its own either.
    DracoFile partly;
    partly.extension()["attributes"].erase("COLOR_0");
    EXPECT_EQ(partly.refusal(), "mesh 'body' primitive 0: COLOR_0: accessor 1: has no data");
}

// Data that is cut off or has flipped bits anywhere; ASan in the sanitizer build detects errors.
TEST(GltfDraco, HostileBytes) {
    DracoFile file;
    std::size_t refused = 0;
    const auto load = [&](const std::vector<char>& bytes) {
        DracoFile hostile;
        hostile.extension()["bufferView"] = hostile.addView(bytes);
        try {
            hostile.load();
        } catch (const Error&) {
            ++refused;
        }
    };
    for (std::size_t size = 0; size < file.bytes.size(); ++size) {
        load({file.bytes.begin(), file.bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    }
    EXPECT_EQ(refused, file.bytes.size());
    for (std::size_t i = 0; i < file.bytes.size(); ++i) {
        std::vector<char> bytes = file.bytes;
        bytes[i] = static_cast<char>(~bytes[i]);
        load(bytes);
    }
}

#ifdef METAMARCH_MESHOPT

// Four vertices of 16 bytes (position and 4 spare bytes) and two triangles.
class MeshoptFile : public GltfFile {
  public:
    MeshoptFile() {
        std::vector<float> vertices;
        for (const glm::vec3& p : kPositions) {
            vertices.insert(vertices.end(), {p.x, p.y, p.z, 0});
        }
        vertexBytes.resize(meshopt_encodeVertexBufferBound(4, 16));
        vertexBytes.resize(
            meshopt_encodeVertexBuffer(vertexBytes.data(), vertexBytes.size(), vertices.data(), 4, 16));
        const std::vector<unsigned> indices = {0, 1, 2, 0, 2, 3};
        indexBytes.resize(meshopt_encodeIndexBufferBound(6, 4));
        indexBytes.resize(
            meshopt_encodeIndexBuffer(indexBytes.data(), indexBytes.size(), indices.data(), indices.size()));

        const int vertexView = addCompressed(
            vertexBytes, {{"count", 4}, {"byteStride", 16}, {"mode", "ATTRIBUTES"}, {"filter", "NONE"}});
        root["bufferViews"][static_cast<std::size_t>(vertexView)]["byteStride"] = 16;
        const int indexView =
            addCompressed(indexBytes, {{"count", 6}, {"byteStride", 2}, {"mode", "TRIANGLES"}});
        primitive()["attributes"]["POSITION"] = addAccessor(
            {{"bufferView", vertexView}, {"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}});
        primitive()["indices"] = addAccessor(
            {{"bufferView", indexView}, {"componentType", kUnsignedShort}, {"count", 6}, {"type", "SCALAR"}});
        root["extensionsRequired"] = {"EXT_meshopt_compression"};
    }

    // Adds a view of the fallback buffer 1, which has no bytes; the compressed bytes lie in buffer 0.
    int addCompressed(const std::vector<unsigned char>& bytes, Json extension) {
        const int view = addView(bytes);
        Json& json = root["bufferViews"][static_cast<std::size_t>(view)];
        extension["buffer"] = 0;
        extension["byteOffset"] = json["byteOffset"];
        extension["byteLength"] = bytes.size();
        json = {{"buffer", 1}, {"byteLength", 64}, {"extensions", {{"EXT_meshopt_compression", extension}}}};
        return view;
    }

    Json& extension(std::size_t view) {
        return root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
    }

    Scene loadCompressed() {
        finish();
        return load();
    }

    std::string refusalOfCompressed() {
        finish();
        return refusal();
    }

    std::vector<unsigned char> vertexBytes;
    std::vector<unsigned char> indexBytes;

  private:
    void finish() {
        root["buffers"] = {
            {{"uri", "scene.bin"}, {"byteLength", byteCount()}},
            {{"byteLength", 1000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    }
};

TEST(GltfMeshopt, DecodesToWhatWasEncoded) {
    MeshoptFile file;
    const Scene scene = file.loadCompressed();
    EXPECT_EQ(scene.positions, kPositions);
    EXPECT_EQ(scene.triangles, Triangles({{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMeshopt, SequenceAndTheNewerName) {
    MeshoptFile file;
    const std::vector<unsigned> indices = {3, 1, 0};
    std::vector<unsigned char> bytes(meshopt_encodeIndexSequenceBound(3, 4));
    bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
    const int view = file.addCompressed(bytes, {{"count", 3}, {"byteStride", 4}, {"mode", "INDICES"}});
    Json& extensions = file.root["bufferViews"][static_cast<std::size_t>(view)]["extensions"];
    extensions = {{"KHR_meshopt_compression", extensions["EXT_meshopt_compression"]}};
    file.root["extensionsRequired"].push_back("KHR_meshopt_compression");
    file.primitive()["indices"] = file.addAccessor(
        {{"bufferView", view}, {"componentType", GltfFile::kUnsignedInt}, {"count", 3}, {"type", "SCALAR"}});
    EXPECT_EQ(file.loadCompressed().triangles, Triangles({{3, 1, 0}}));
}

TEST(GltfMeshopt, OctahedralFilter) {
    MeshoptFile file;
    // +z, +x, -z, +y in 8 bits; the third number is the value that stands for 1.
    const std::vector<std::int8_t> encoded = {0, 0, 127, 0, 127, 0, 127, 0, 127, 127, 127, 0, 0, 127, 127, 0};
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4, 4));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), encoded.data(), 4, 4));
    const int view = file.addCompressed(
        bytes, {{"count", 4}, {"byteStride", 4}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}});
    file.primitive()["attributes"]["NORMAL"] = file.addAccessor({{"bufferView", view},
                                                                 {"componentType", GltfFile::kByte},
                                                                 {"normalized", true},
                                                                 {"count", 4},
                                                                 {"type", "VEC3"}});
    const Positions normals = file.loadCompressed().normals;
    EXPECT_LT(glm::distance(normals[0], glm::vec3(0, 0, 1)), 0.01f);
    EXPECT_LT(glm::distance(normals[1], glm::vec3(1, 0, 0)), 0.01f);
    EXPECT_LT(glm::distance(normals[2], glm::vec3(0, 0, -1)), 0.01f);
    EXPECT_LT(glm::distance(normals[3], glm::vec3(0, 1, 0)), 0.01f);
}

TEST(GltfMeshopt, WhatTheDecodersTakeForGrantedIsChecked) {
    const std::vector<std::pair<Json, std::string>> cases = {
        {{{"byteStride", 6}}, "byteStride 6 is none of mode ATTRIBUTES"},
        {{{"byteStride", 260}}, "byteStride 260 is none of mode ATTRIBUTES"},
        {{{"byteStride", 0}}, "has no byteStride"},
        {{{"count", 0}}, "has no count"},
        {{{"count", 2000000000}}, "count 2000000000 is more than"},
        {{{"count", -1}}, "count: -1 is not an integer"},
        {{{"mode", "SHAPES"}}, "mode 'SHAPES' is none of ATTRIBUTES, TRIANGLES, INDICES"},
        {{{"mode", "TRIANGLES"}, {"byteStride", 4}}, "count 4 is no whole number of triangles"},
        {{{"mode", "INDICES"}}, "byteStride 16 is none of mode INDICES"},
        {{{"filter", "COLOR"}}, "filter 'COLOR' is not supported"},
        {{{"filter", "OCTAHEDRAL"}}, "filter OCTAHEDRAL does not go with mode ATTRIBUTES and byteStride 16"},
        {{{"filter", "QUATERNION"}}, "filter QUATERNION does not go with"},
        {{{"buffer", 9}}, "buffer 9 does not exist, there are 2"},
        {{{"byteOffset", 100000}}, "reaches past the end of buffer 0"},
        {{{"byteLength", 100000}}, "reaches past the end of buffer 0"},
        {{{"buffer", 1}, {"byteOffset", 0}}, "reaches past the end of buffer 1"},
        {{{"byteLength", 3}}, "cannot be decoded"},
    };
    for (const auto& [change, line] : cases) {
        MeshoptFile file;
        file.extension(0).update(change);
        const std::string found = file.refusalOfCompressed();
        EXPECT_TRUE(found.starts_with("buffer view 0: meshopt compression: " + line)) << found;
    }
}

TEST(GltfMeshopt, HostileBytes) {
    const MeshoptFile sound;
    for (const bool vertices : {true, false}) {
        const std::vector<unsigned char>& bytes = vertices ? sound.vertexBytes : sound.indexBytes;
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            std::vector<unsigned char> flipped = bytes;
            flipped[i] = static_cast<unsigned char>(~flipped[i]);
            MeshoptFile file;
            const std::size_t view = vertices ? 0 : 1;
            const auto replaced = static_cast<std::size_t>(file.addCompressed(flipped, file.extension(view)));
            file.root["bufferViews"][view] = file.root["bufferViews"][replaced];
            try {
                file.loadCompressed();
            } catch (const Error& error) {
                EXPECT_EQ(error.kind, ErrorKind::inputRefused);
            }
        }
    }
}

TEST(GltfMeshopt, ViewOfTheFallbackBufferHasNoBytes) {
    MeshoptFile file;
    file.root["bufferViews"][0].erase("extensions");
    EXPECT_NE(file.refusalOfCompressed().find("buffer view 0 reaches past the end of buffer 1"),
              std::string::npos);
}

#endif

} // namespace
} // namespace metamarch
