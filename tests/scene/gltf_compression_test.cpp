// SPDX-License-Identifier: MIT
// Draco and meshopt: decoding restores what was encoded, and hostile bytes are refused.
#include "metamarch/error/error.h"
#include "metamarch/scene/gltf/meshopt_attributes.h"
#include "scene/gltf_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <random>

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

const std::vector<glm::vec3> kNormals = {{0, 0, 1}, {0, 0, 1}, {0.6f, 0, -0.8f}, {-1, 0, 0}};

// The ids of Draco's attributes.
struct DracoIds {
    int position = 0;
    int color = 0;
    int normal = 0;
};

// Returns two triangles by sequential encoding, with so many bits for coordinates. Without bits nothing is
// lost, and there are no normals.
std::vector<char> dracoBytes(DracoIds& ids, const int bits) {
    draco::Mesh mesh;
    mesh.set_num_points(4);
    const int position =
        addAttribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, &kPositions[0].x);
    const int color = addAttribute(mesh, draco::GeometryAttribute::COLOR, draco::DT_UINT8, kColors.data());
    ids.position = static_cast<int>(mesh.attribute(position)->unique_id());
    ids.color = static_cast<int>(mesh.attribute(color)->unique_id());
    if (bits != 0) {
        const int normal =
            addAttribute(mesh, draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, &kNormals[0].x);
        ids.normal = static_cast<int>(mesh.attribute(normal)->unique_id());
    }
    mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
    mesh.AddFace({draco::PointIndex(0), draco::PointIndex(2), draco::PointIndex(3)});
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    if (bits != 0) {
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
        encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, bits);
    }
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

class DracoFile : public GltfFile {
  public:
    explicit DracoFile(const int bits = 0) {
        DracoIds ids;
        bytes = dracoBytes(ids, bits);
        primitive()["attributes"] = {
            {"POSITION", addAccessor({{"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}})},
            {"COLOR_0",
             addAccessor(
                 {{"componentType", kUnsignedByte}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}})}};
        primitive()["indices"] =
            addAccessor({{"componentType", kUnsignedShort}, {"count", 6}, {"type", "SCALAR"}});
        extension() = {{"bufferView", addView(bytes)},
                       {"attributes", {{"POSITION", ids.position}, {"COLOR_0", ids.color}}}};
        if (bits != 0) {
            primitive()["attributes"]["NORMAL"] =
                addAccessor({{"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}});
            extension()["attributes"]["NORMAL"] = ids.normal;
        }
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

// The bits are those of one rounding for each operation.
TEST(GltfDraco, QuantizedCoordinates) {
    for (const int bits : {2, 5, 8, 11, 14, 16}) {
        DracoFile file(bits);
        const Scene scene = file.load();
        const auto steps = static_cast<float>((1 << bits) - 1);
        const float step = 1.0f / steps;
        ASSERT_EQ(scene.positions.size(), 4u);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(scene.positions[i], glm::floor(kPositions[i] * steps + 0.5f) * step) << bits;
            EXPECT_LT(glm::distance(scene.normals[i], kNormals[i]), 3.0f / steps + 1e-6f) << bits;
            EXPECT_NEAR(glm::length(scene.normals[i]), 1.0f, 1e-6f);
        }
    }
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
void expectHostileBytesAreRead(const int bits) {
    DracoFile file(bits);
    std::size_t refused = 0;
    const auto load = [&](const std::vector<char>& bytes) {
        DracoFile hostile(bits);
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

TEST(GltfDraco, HostileBytes) { expectHostileBytesAreRead(0); }
TEST(GltfDraco, HostileBytesOfQuantizedCoordinates) { expectHostileBytesAreRead(11); }

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

    // Replaces the extensions of element 1 of a list.
    std::string refusalOfExtensions(const char* list, const Json& extensions) {
        finish();
        root[list][1]["extensions"] = extensions;
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

// The positions and colours of gltf_khr_meshopt_v1, encoded by meshoptimizer 1.3.0: the square from -1 to 1,
// and the colour 255 128 64 255 four times.
TEST(GltfMeshopt, AttributesOfVersion1) {
    const auto decode = [](std::vector<unsigned char> stream, std::size_t stride) {
        return decodeMeshoptAttributes(stream, 4, stride);
    };
    const std::vector<unsigned char> positions = {0xa1, 0xea, 0xea, 0xaa, 0x00, 0xff, 0x00, 0xff, 0x00,
                                                  0x00, 0xff, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                                                  0x00, 0x00, 0x00, 0x00, 0x00, 0x80, 0xbf, 0x00, 0x00,
                                                  0x80, 0xbf, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
    const auto bytes = decode(positions, 12);
    ASSERT_TRUE(bytes);
    std::vector<glm::vec3> decoded(4);
    std::memcpy(decoded.data(), bytes->data(), bytes->size());
    EXPECT_EQ(decoded, Positions({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}));
    for (std::size_t size = 0; size < positions.size(); ++size) {
        EXPECT_FALSE(decode({positions.begin(), positions.begin() + static_cast<std::ptrdiff_t>(size)}, 12));
    }
}

// Streams by hand. Every byte is stored as it is (control mode 3); the tail is the element before the first,
// and the mode of the channel.
TEST(GltfMeshopt, ChannelsOfVersion1) {
    const auto decode = [](std::vector<unsigned char> columns, const std::vector<unsigned char>& before,
                           unsigned char mode) {
        std::vector<unsigned char> stream = {0xa1, 0xff};
        stream.insert(stream.end(), columns.begin(), columns.end());
        stream.resize(stream.size() + 24 - 5, 0);
        stream.insert(stream.end(), before.begin(), before.end());
        stream.push_back(mode);
        return decodeMeshoptAttributes(stream, 2, 4);
    };
    using Stream = std::vector<unsigned char>;
    // Bytes: +1 and -1 are coded as 2 and 1.
    EXPECT_EQ(decode({2, 1, 0, 0, 4, 4, 1, 2}, {10, 20, 255, 0}, 0), Stream({11, 20, 1, 255, 10, 20, 3, 0}));
    // Words: from 0x00ff by +1 and by -257, which is coded as 513; from 0xffff by +1 and by 0.
    EXPECT_EQ(decode({2, 1, 0, 2, 2, 0, 0, 0}, {0xff, 0x00, 0xff, 0xff}, 1),
              Stream({0x00, 0x01, 0x00, 0x00, 0xff, 0xff, 0x00, 0x00}));
    // Exclusive or with 0x00000001 and 0x80000000, turned right by 9. meshoptimizer 1.3.0 decodes the same
    // bytes.
    EXPECT_EQ(decode({1, 0, 0, 0, 0, 0, 0, 0x80}, {1, 2, 3, 4}, 0x92),
              Stream({1, 2, 3 ^ 0x80, 4, 1, 2, 131 ^ 0x40, 4}));
    EXPECT_FALSE(decode({2, 1, 0, 0, 4, 4, 1, 2}, {10, 20, 255, 0}, 3));
    EXPECT_FALSE(decode({2, 1, 0, 0, 4, 4, 1, 2}, {10, 20, 255, 0}, 0x11));
    // One byte is left over.
    EXPECT_FALSE(decode({2, 1, 0, 0, 4, 4, 1, 2, 9}, {10, 20, 255, 0}, 0));
}

// The encoder of meshoptimizer 1.3.0 has written this stream at level 3, in mode 0x12.
TEST(GltfMeshopt, FloatsOfVersion1) {
    const std::vector<unsigned char> stream = {161, 105, 1,   4,   16,  65,  4,   2,   0,   1,  1,   55,  92,
                                               247, 92,  255, 254, 255, 255, 255, 254, 255, 15, 0,   255, 255,
                                               1,   254, 0,   0,   0,   0,   0,   0,   0,   0,  0,   0,   0,
                                               0,   0,   0,   0,   0,   0,   0,   0,   0,   0,  128, 191, 18};
    const std::vector<float> expected = {-1, -2, 4,     1,  0.5f, -1, -2, -2, 1,  2,
                                         4,  -1, -0.5f, -1, 2,    2,  1,  -2, -4, -1};
    const auto decoded = decodeMeshoptAttributes(stream, expected.size(), sizeof(float));
    ASSERT_TRUE(decoded);
    std::vector<float> floats(expected.size());
    ASSERT_EQ(decoded->size(), floats.size() * sizeof(float));
    std::memcpy(floats.data(), decoded->data(), decoded->size());
    EXPECT_EQ(floats, expected);
}

// Several blocks, groups of every bit length, and elements that end inside a group.
TEST(GltfMeshopt, ManyAttributes) {
    std::mt19937 random(7);
    for (const std::size_t stride : {4u, 16u, 68u, 256u}) {
        std::vector<unsigned char> elements(777 * stride);
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const unsigned spread = 1u << (i / stride / 100);
            elements[i] = static_cast<unsigned char>(i % 3 == 0 ? random() % spread : i / stride);
        }
        std::vector<unsigned char> stream(meshopt_encodeVertexBufferBound(777, stride));
        stream.resize(meshopt_encodeVertexBuffer(stream.data(), stream.size(), elements.data(), 777, stride));
        EXPECT_EQ(decodeMeshoptAttributes(stream, 777, stride), elements) << stride;
        EXPECT_FALSE(decodeMeshoptAttributes(stream, 700, stride));
    }
}

// The specification's transform by hand, in 8 bits: Y, Co, Cg and alpha, whose highest bit ends the range.
TEST(GltfMeshopt, ColorFilter) {
    std::vector<unsigned char> eight = {
        100,  20, static_cast<unsigned char>(-30),
        0xff, // 100 + 20 + 30, 100 - 30, 100 - 20 + 30; opaque
        5,    3,  2,
        0x0a, // range 15, scale 17: 6, 7, 0; alpha 2 of 7 is 4 of 15
        0,    0,  0,
        0,
    };
    decodeMeshoptColors(eight, 4);
    EXPECT_EQ(eight, std::vector<unsigned char>({150, 70, 110, 255, 102, 119, 0, 68, 0, 0, 0, 0}));
    // In 16 bits with a range of 1023, whose scale is 64.06.
    std::array<std::uint16_t, 4> sixteen = {500, 100, static_cast<std::uint16_t>(-200), 0x3ff};
    std::vector<unsigned char> bytes(8);
    std::memcpy(bytes.data(), sixteen.data(), 8);
    decodeMeshoptColors(bytes, 8);
    std::memcpy(sixteen.data(), bytes.data(), 8);
    EXPECT_EQ(sixteen, (std::array<std::uint16_t, 4>{51249, 19218, 38437, 65535}));
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
        {{{"byteStride", 6}}, "byteStride 6 is not a multiple of 4 up to 256, as mode ATTRIBUTES wants"},
        {{{"byteStride", 260}}, "byteStride 260 is not a multiple of 4 up to 256"},
        {{{"byteStride", 0}}, "has no byteStride"},
        {{{"count", 0}}, "has no count"},
        {{{"count", 2000000000}}, "count 2000000000 is more than"},
        {{{"count", -1}}, "count: -1 is not an integer"},
        {{{"mode", "SHAPES"}}, "mode 'SHAPES' is none of ATTRIBUTES, TRIANGLES, INDICES"},
        {{{"mode", "TRIANGLES"}, {"byteStride", 4}}, "count 4 is no whole number of triangles"},
        {{{"mode", "INDICES"}}, "byteStride 16 is not 2 or 4, as mode INDICES wants"},
        {{{"filter", "PAINT"}}, "filter 'PAINT' is not supported"},
        {{{"filter", "COLOR"}}, "filter COLOR does not go with mode ATTRIBUTES and byteStride 16"},
        {{{"filter", "OCTAHEDRAL"}}, "filter OCTAHEDRAL does not go with mode ATTRIBUTES and byteStride 16"},
        {{{"filter", "QUATERNION"}}, "filter QUATERNION does not go with"},
        {{{"buffer", 9}}, "buffer 9 does not exist, there are 2"},
        {{{"byteOffset", 100000}}, "reaches past the end of buffer 0"},
        {{{"byteLength", 100000}}, "reaches past the end of buffer 0"},
        {{{"buffer", 1}, {"byteOffset", 0}}, "reaches past the end of buffer 1"},
        {{{"byteLength", 3}}, "cannot be decoded: the stream is broken or cut off"},
        {{{"byteOffset", 1}}, "mode ATTRIBUTES has no codec with the header byte 0x"},
    };
    for (const auto& [change, line] : cases) {
        MeshoptFile file;
        file.extension(0).update(change);
        const std::string found = file.refusalOfCompressed();
        EXPECT_TRUE(found.starts_with("buffer view 0: EXT_meshopt_compression: " + line)) << found;
    }
}

TEST(GltfMeshopt, BrokenExtensionsAreRefused) {
    const auto expect = [](const char* list, const Json& extensions, const std::string& line) {
        MeshoptFile file;
        EXPECT_EQ(file.refusalOfExtensions(list, extensions), line);
    };
    for (const std::string name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        expect("buffers", {{name, Json::array()}}, "buffer 1: " + name + ": is not an object");
        expect("buffers", {{name, {{"fallback", "yes"}}}},
               "buffer 1: " + name + ": fallback is neither true nor false");
        expect("bufferViews", {{name, Json::array()}}, "buffer view 1: " + name + ": is not an object");
    }
    expect("buffers", Json::array(), "buffer 1: extensions: is not an object");
    expect("bufferViews", Json::array(), "buffer view 1: extensions: is not an object");
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
