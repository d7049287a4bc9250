// SPDX-License-Identifier: MIT
// PLY: the square that most of these files hold has 4 square units and faces +z.
#include "scene/mesh_file.h"
#include "scene/picture_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace metamarch {
namespace {

using Triangles = std::vector<glm::uvec3>;

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kVertexElement = "element vertex 4\n" + kXyz;
const std::string kFaceElement = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kVertices = "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n";
const std::string kFace = "4 0 1 2 3\n";

std::string ascii(const std::string& header, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

const std::string kSquare = ascii(kVertexElement + kFaceElement, kVertices + kFace);

std::string binary(std::endian order, const std::string& header, const BinaryText& body) {
    return std::string("ply\nformat ") +
           (order == std::endian::little ? "binary_little_endian" : "binary_big_endian") + " 1.0\n" + header +
           "end_header\n" + body.text();
}

const std::vector<float> kPositions = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};

BinaryText squareBody(std::endian order) {
    BinaryText body(order);
    body.add(kPositions).add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3});
    return body;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

// IEC 61966-2-1
float linear(double encoded) {
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

class Ply : public MeshFileTest {
  protected:
    void expectSquare(const std::string& content, const std::vector<std::string>& warnings = {}) {
        const Scene scene = load("a.ply", content, warnings);
        EXPECT_DOUBLE_EQ(areaOf(scene), 4.0) << content.substr(0, 400);
        EXPECT_DOUBLE_EQ(frontAreaOf(scene), 4.0) << content.substr(0, 400);
    }

    std::string refused(const std::string& content) { return refusal("a.ply", content); }
};

TEST_F(Ply, CommentsAnywhereInTheHeader) {
    expectSquare(kSquare);
    expectSquare(replaced(kSquare, "property float x", "comment a\nproperty float x")); // assimp#4866
    expectSquare(replaced(kSquare, "property float y", "obj_info b element vertex 9\nproperty float y"));
    expectSquare(replaced(kSquare, "format", "comment\ncomment end_header in a comment\nformat"));
    expectSquare(replaced(kSquare, "end_header", "comment property float w\n\nend_header"));
}

// Cut down from a file in which two readers of one header understood a comment differently: 315 bytes asked
// for 2.2 GB.
TEST_F(Ply, CommentBetweenPropertiesOfBinaryFaces) {
    const std::string header = kVertexElement + "comment element vertex 1000000000\n" +
                               replaced(kFaceElement, "1\n", "1\ncomment list\n");
    expectSquare(binary(std::endian::little, header, squareBody(std::endian::little)));
}

TEST_F(Ply, AllEncodings) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        expectSquare(binary(order, kVertexElement + kFaceElement, squareBody(order)));
    }
}

TEST_F(Ply, EveryEndOfAHeaderLine) {
    for (const char* end : {"\r\n", "\r"}) {
        std::string text;
        for (const char c : kSquare) {
            text += c == '\n' ? std::string(end) : std::string(1, c);
        }
        expectSquare(text);
    }
}

// One of 256 files (assimp#5341, #5692). The body of a binary file begins right behind the end of the last
// line.
TEST_F(Ply, BodyBeginsWithALineFeed) {
    for (const char* end : {"\n", "\r\n", "\r"}) {
        // -1.0000011 and -2.1e-35: the lowest byte, or the highest, is 0x0a.
        for (const std::endian order : {std::endian::little, std::endian::big}) {
            const float first =
                std::bit_cast<float>(order == std::endian::little ? 0xbf80000au : 0x0a800000u);
            BinaryText body(order);
            body.add<float>({first, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
            body.add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3});
            std::string header;
            for (const char c : binary(order, kVertexElement + kFaceElement, BinaryText(order))) {
                header += c == '\n' ? std::string(end) : std::string(1, c);
            }
            const Scene scene = load("a.ply", header + body.text());
            EXPECT_EQ(scene.positions.at(0).x, first);
            EXPECT_EQ(scene.positions.at(3), glm::vec3(-1, 1, 0));
        }
    }
}

TEST_F(Ply, TrailingBytes) {
    expectSquare(kSquare + "\n\n");
    expectSquare(binary(std::endian::little, kVertexElement + kFaceElement, squareBody(std::endian::little)) +
                     std::string(92, '\0'),
                 {"PLY: 92 bytes after the last element are not read"});
    expectSquare(kSquare + "0 1\n \n1 2 \n", {"PLY: 11 bytes after the last element are not read"});
    expectSquare(kSquare.substr(0, kSquare.size() - 1) + " 7\n",
                 {"PLY: 1 lines have more numbers than their elements; these are not read"});
    expectSquare(kSquare.substr(0, kSquare.size() - 1)); // no line feed at the end
}

TEST_F(Ply, UnknownElementsAndPropertiesAreSkipped) {
    const std::string foo = "element foo 2\nproperty int a\nproperty list uchar float b\n";
    expectSquare(ascii(foo + kVertexElement + kFaceElement, "7 2 0.5 0.5\n8 0\n" + kVertices + kFace),
                 {"PLY: elements are not read: 2 'foo'"});
    expectSquare(ascii(kVertexElement + "element edge 1\nproperty int vertex1\nproperty int vertex2\n" +
                           kFaceElement + "element empty 1000000000000\n",
                       kVertices + "0 1\n" + kFace),
                 {"PLY: elements are not read: 1 'edge'"});
    const std::string vertex = "element vertex 4\nproperty list ushort double w\nproperty uchar x_weight\n" +
                               kXyz + "property double q\n";
    const std::string face = "element face 1\nproperty int material\nproperty list uint uint vertex_index\n"
                             "property list char short flags\n";
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        BinaryText body(order);
        body.add<std::int32_t>({7}).add<std::uint8_t>({2}).add<float>({1, 2});
        body.add<std::int32_t>({8}).add<std::uint8_t>({0});
        for (std::size_t i = 0; i < 4; ++i) {
            body.add<std::uint16_t>({1}).add<double>({0.5}).add<std::uint8_t>({9});
            body.add<float>({kPositions[3 * i], kPositions[3 * i + 1], kPositions[3 * i + 2]})
                .add<double>({1.0});
        }
        body.add<std::int32_t>({1})
            .add<std::uint32_t>({4, 0, 1, 2, 3})
            .add<std::int8_t>({1})
            .add<std::int16_t>({5});
        expectSquare(binary(order, std::string(foo).append(vertex).append(face), body),
                     {"PLY: elements are not read: 2 'foo'"});
    }
}

TEST_F(Ply, NumbersOfEveryType) {
    const auto file = [](const std::string& type, const std::string& countType, const std::string& indexType,
                         const BinaryText& body) {
        return binary(std::endian::big,
                      "element vertex 4\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type +
                          " z\nelement face 1\nproperty list " + countType + ' ' + indexType +
                          " vertex_indices\n",
                      body);
    };
    const auto body = [] { return BinaryText(std::endian::big); };
    const std::vector<double> square(kPositions.begin(), kPositions.end());
    expectSquare(file("double", "uchar", "int",
                      body().add(square).add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3})));
    const std::vector<std::int8_t> bytes(kPositions.begin(), kPositions.end());
    expectSquare(file("char", "char", "uchar",
                      body().add(bytes).add<std::int8_t>({4}).add<std::uint8_t>({0, 1, 2, 3})));
    const std::vector<std::int16_t> shorts(kPositions.begin(), kPositions.end());
    expectSquare(file("int16", "ushort", "short",
                      body().add(shorts).add<std::uint16_t>({4}).add<std::int16_t>({0, 1, 2, 3})));
    const std::vector<std::int32_t> ints(kPositions.begin(), kPositions.end());
    expectSquare(file("int32", "uint32", "uint16",
                      body().add(ints).add<std::uint32_t>({4}).add<std::uint16_t>({0, 1, 2, 3})));
    expectSquare(file("float64", "uint8", "float",
                      body().add(square).add<std::uint8_t>({4}).add<float>({0, 1, 2, 3})));
    // Positions without sign: a square of 2 x 2 at (0, 0).
    expectSquare(file(
        "uchar", "uint8", "uint",
        body().add<std::uint8_t>({0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 4}).add<std::uint32_t>({0, 1, 2, 3})));
}

TEST_F(Ply, PolygonsOfAnyLength) {
    std::string header =
        "element vertex 300\n" + kXyz + "element face 1\nproperty list ushort int vertex_indices\n";
    std::string vertices;
    std::string face = "300";
    double area = 0.0;
    for (int i = 0; i < 300; ++i) {
        const double angle = 2.0 * M_PI * i / 300.0;
        vertices += std::to_string(std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + " 0\n";
        face += ' ' + std::to_string(i);
        area += 0.5 * std::sin(2.0 * M_PI / 300.0);
    }
    const Scene scene = load("a.ply", ascii(header, vertices + face + '\n'));
    EXPECT_EQ(scene.triangles.size(), 298u);
    EXPECT_NEAR(frontAreaOf(scene), area, 1e-4);
}

TEST_F(Ply, ConcavePolygon) {
    const std::string vertices = "0 0 0\n4 0 0\n4 4 0\n3 1 0\n"; // an arrowhead of 4 square units
    expectSquare(ascii(kVertexElement + kFaceElement, vertices + "4 0 1 2 3\n"));
    expectSquare(ascii(kVertexElement + kFaceElement, vertices + "4 1 2 3 0\n"));
}

TEST_F(Ply, StripsWithRestarts) {
    const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
    expectSquare(ascii(kVertexElement + strips, kVertices + "4 0 1 3 2\n")); // assimp#6296
    expectSquare(ascii(kVertexElement + strips, kVertices + "7 0 1 2 -1 0 2 3\n"));
    expectSquare(ascii(kVertexElement + strips, kVertices + "10 -1 0 1 2 -1 -1 0 2 3 -1\n"));
    // Repeated vertices join the strips, and an odd triangle begins the second.
    expectSquare(ascii(kVertexElement + strips, kVertices + "10 0 1 2 2 0 0 0 2 3 3\n"));
    const std::string two = "element tristrips 2\nproperty list uchar int vertex_index\n";
    expectSquare(ascii(kVertexElement + two, kVertices + "3 0 1 2\n3 0 2 3\n"));
    BinaryText body(std::endian::little);
    body.add(kPositions).add<std::uint32_t>({7, 0, 1, 2, 0xffffffffu, 0, 2, 3});
    expectSquare(binary(std::endian::little,
                        kVertexElement + "element tristrips 1\nproperty list uint uint vertex_indices\n",
                        body));
    EXPECT_EQ(refused(ascii(kVertexElement + strips, kVertices + "4 0 1 3 -2\n")),
              "PLY tristrips 0: vertex index -2 is out of range, there are 4 vertices");
}

// A strip's triangles are those of OpenGL: every second one is turned, so that all have the same front.
TEST_F(Ply, StripsKeepTheFront) {
    const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
    const Scene scene = load("a.ply", ascii("element vertex 6\n" + kXyz + strips,
                                            "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n6 1 0 3 2 5 4\n"));
    EXPECT_EQ(scene.triangles, Triangles({{1, 0, 3}, {3, 0, 2}, {3, 2, 5}, {5, 2, 4}}));
    EXPECT_DOUBLE_EQ(frontAreaOf(scene), 2.0);
}

TEST_F(Ply, RangeGrid) {
    const std::string header = "obj_info num_cols 3\nobj_info num_rows 2\nelement vertex 5\n" + kXyz +
                               "element range_grid 6\nproperty list uchar int vertex_indices\n";
    const std::string vertices = "0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n";
    // The upper right place is empty: a square and a triangle.
    const Scene scene = load("a.ply", ascii(header, vertices + "1 0\n1 1\n1 2\n1 3\n1 4\n0\n"));
    EXPECT_EQ(scene.triangles.size(), 3u);
    EXPECT_DOUBLE_EQ(frontAreaOf(scene), 1.5);
    EXPECT_EQ(refused(ascii(replaced(header, "num_cols 3", "num_cols 4"),
                            vertices + "1 0\n1 1\n1 2\n1 3\n1 4\n0\n")),
              "PLY: obj_info gives the range grid 4 columns and 2 rows, but it has 6 places");
}

// The shorter diagonal is the ridge.
TEST_F(Ply, RangeGridDividesAlongTheShorterDiagonal) {
    const std::string header = "obj_info num_cols 2\nobj_info num_rows 2\n" + kVertexElement +
                               "element range_grid 4\nproperty list uchar int vertex_indices\n";
    const Scene scene = load("a.ply", ascii(header, "0 0 0\n1 0 1\n0 1 1\n1 1 0.5\n1 0\n1 1\n1 2\n1 3\n"));
    EXPECT_EQ(scene.triangles, Triangles({{0, 1, 2}, {1, 3, 2}}));
}

TEST_F(Ply, VertexColors) {
    const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const Scene red =
        load("a.ply", ascii(kVertexElement + colors + kFaceElement,
                            "-1 -1 0 255 0 0\n1 -1 0 255 0 0\n1 1 0 255 0 0\n-1 1 0 255 0 0\n" + kFace));
    EXPECT_EQ(red.colors, std::vector<glm::vec4>(4, glm::vec4(1, 0, 0, 1)));
    ASSERT_EQ(red.triangleMaterial, std::vector<std::uint32_t>({0, 0}));
    EXPECT_EQ(red.materials[0].baseColorFactor, glm::vec4(1));
    EXPECT_EQ(red.materials[0].metallicFactor, 0.0f);
    EXPECT_EQ(red.materials[0].alphaMode, AlphaMode::opaque);

    const Scene grey =
        load("a.ply", ascii(kVertexElement +
                                "property uint8 diffuse_red\nproperty uint8 diffuse_green\n"
                                "property uint8 diffuse_blue\n" +
                                kFaceElement,
                            "-1 -1 0 1 127 128\n1 -1 0 0 0 0\n1 1 0 0 0 0\n-1 1 0 0 0 0\n" + kFace));
    EXPECT_EQ(grey.colors.at(0), glm::vec4(linear(1 / 255.0), linear(127 / 255.0), linear(128 / 255.0), 1));
}

TEST_F(Ply, ColorsOfEveryType) {
    const auto firstColor = [this](const std::string& type, const std::string& color) {
        const std::string colors =
            "property " + type + " red\nproperty " + type + " green\nproperty " + type + " blue\n";
        return load("a.ply",
                    ascii(kVertexElement + colors + kFaceElement,
                          "-1 -1 0 " + color + "\n1 -1 0 0 0 0\n1 1 0 0 0 0\n-1 1 0 0 0 0\n" + kFace))
            .colors.at(0);
    };
    const glm::vec4 half(linear(0.5), 1, 0, 1);
    const auto expectNear = [](const glm::vec4& found, const glm::vec4& expected) {
        EXPECT_LT(glm::distance(found, expected), 1e-6f) << found.x << ' ' << found.y << ' ' << found.z;
    };
    expectNear(firstColor("float", "0.5 1 0"), half);
    expectNear(firstColor("double", "0.5 1 0"), half);
    expectNear(firstColor("float", "0.5 1.0000001 0"), half); // a little above 1 is 1
    expectNear(firstColor("double", "0.5 1.5 0"), half);
    expectNear(firstColor("float", "127.5 255 0"), half); // some programs write fractions like this
    expectNear(firstColor("ushort", "32767.5 65535 0"), half);
    expectNear(firstColor("int", "127.5 255 0"), half);
    expectNear(firstColor("uchar", "1 0 0"), glm::vec4(linear(1 / 255.0), 0, 0, 1));
}

TEST_F(Ply, AlphaBlends) {
    const auto load4 = [this](const std::string& alpha) {
        const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                   "property uchar alpha\n";
        const std::string rest = " 255 255 255 " + alpha + '\n';
        return load("a.ply",
                    ascii(kVertexElement + colors + kFaceElement,
                          "-1 -1 0" + rest + "1 -1 0" + rest + "1 1 0" + rest + "-1 1 0" + rest + kFace));
    };
    const Scene clear = load4("51");
    EXPECT_FLOAT_EQ(clear.colors.at(0).a, 0.2f);
    EXPECT_EQ(clear.materials.at(0).alphaMode, AlphaMode::blend);
    EXPECT_EQ(load4("1.00001").colors.at(0).a, 1.0f); // rounded up
    EXPECT_EQ(load4("255").materials.at(0).alphaMode, AlphaMode::opaque);
    EXPECT_EQ(load4("0").materials.at(0).alphaMode, AlphaMode::opaque); // nothing would be seen
}

TEST_F(Ply, FaceColors) {
    const std::string faces = "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n"
                              "property uchar green\nproperty uchar blue\n";
    const Scene scene =
        load("a.ply", ascii(kVertexElement + faces, kVertices + "3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n"));
    ASSERT_EQ(scene.triangles.size(), 2u);
    for (std::size_t corner = 0; corner < 6; ++corner) {
        EXPECT_EQ(colorOfCorner(scene, corner), corner < 3 ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1));
    }
    EXPECT_DOUBLE_EQ(frontAreaOf(scene), 4.0);
}

TEST_F(Ply, Normals) {
    const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
    const Scene scene =
        load("a.ply", ascii(kVertexElement + normals + kFaceElement,
                            "-1 -1 0 0 0 2\n1 -1 0 0 0 1\n1 1 0 0 1 0\n-1 1 0 1 0 0\n" + kFace));
    EXPECT_EQ(scene.normals, std::vector<glm::vec3>({{0, 0, 1}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
}

TEST_F(Ply, TexCoordsOfVertices) {
    for (const char* names : {"u v", "s t", "texture_u texture_v"}) {
        const std::string both(names);
        const std::string texCoords = "property float " + both.substr(0, both.find(' ')) +
                                      "\nproperty float " + both.substr(both.find(' ') + 1) + '\n';
        const Scene scene =
            load("a.ply", ascii(std::string(kVertexElement).append(texCoords).append(kFaceElement),
                                "-1 -1 0 0 0\n1 -1 0 1 0\n1 1 0 1 0.75\n-1 1 0 0 1\n" + kFace));
        EXPECT_EQ(scene.texCoords, std::vector<glm::vec2>({{0, 1}, {1, 1}, {1, 0.25f}, {0, 0}})) << names;
        EXPECT_EQ(scene.triangleMaterial.at(0), kNoMaterial);
    }
}

// MeshLab writes every textured PLY like this (meshlab#290, assimp#5010).
TEST_F(Ply, TexCoordsOfCornersAndTheirFile) {
    writeFile(folder / "t a.png", pngFile(1, 1, 3, {10, 20, 30}));
    const std::string face = kFaceElement + "property list uchar float texcoord\n";
    const std::string header =
        "comment VCGLIB generated\ncomment TextureFile t a.png \n" + kVertexElement + face;
    BinaryText body(std::endian::little);
    body.add(kPositions).add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3});
    body.add<std::uint8_t>({8}).add<float>({0, 0, 1, 0, 1, 1, 0, 0.75f});
    const Scene scene = load("a.ply", binary(std::endian::little, header, body));
    EXPECT_DOUBLE_EQ(frontAreaOf(scene), 4.0);
    const std::vector<glm::vec2> expected = {{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0.25f}};
    for (std::size_t corner = 0; corner < 6; ++corner) {
        EXPECT_EQ(texCoordOfCorner(scene, corner), expected[corner]);
    }
    const Material& material = scene.materials.at(scene.triangleMaterial.at(0));
    ASSERT_NE(material.baseColorTexture.texture, kNoTexture);
    EXPECT_TRUE(material.baseColorTexture.isSrgb);
    EXPECT_EQ(scene.images.at(scene.textures.at(0).image).bytes.at(0), glm::u8vec4(10, 20, 30, 255));
}

TEST_F(Ply, TextureNumbersChooseTheFile) {
    writeFile(folder / "red.png", pngFile(1, 1, 3, {255, 0, 0}));
    writeFile(folder / "blue.png", pngFile(1, 1, 3, {0, 0, 255}));
    const std::string header = "comment TextureFile red.png\ncomment TextureFile blue.png\n" +
                               kVertexElement +
                               "element face 3\nproperty list uchar int vertex_indices\n"
                               "property list uchar float texcoord\nproperty int texnumber\n";
    const Scene scene = load("a.ply",
                             ascii(header, kVertices + "3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 0 0 1 1 0 1 0\n"
                                                       "3 0 1 2 0 -1\n"),
                             {"PLY: 1 faces do not have one texture coordinate for each corner; zero is used",
                              "PLY: 1 faces have a texture number without a file"});
    const auto texel = [&scene](std::size_t triangle) {
        const Material& material = scene.materials.at(scene.triangleMaterial.at(triangle));
        return scene.images.at(scene.textures.at(material.baseColorTexture.texture).image).bytes.at(0);
    };
    ASSERT_EQ(scene.triangles.size(), 3u);
    // Triangles are in the order of their materials' first faces.
    EXPECT_EQ(texel(0), glm::u8vec4(0, 0, 255, 255));
    EXPECT_EQ(texel(1), glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(scene.triangleMaterial.at(2), kNoMaterial);
}

TEST_F(Ply, TexturesAreFoundBesideTheFile) {
    writeFile(folder / "t.png", pngFile(1, 1, 3, {10, 20, 30}));
    for (const char* name : {"C:\\Users\\me\\t.png", "/home/me/t.png", "textures/t.png", "\"t.png\""}) {
        const Scene scene = load("a.ply", ascii(std::string("comment TextureFile ")
                                                    .append(name)
                                                    .append("\n")
                                                    .append(kVertexElement)
                                                    .append(kFaceElement)
                                                    .append("property list uchar float texcoord\n"),
                                                kVertices + "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n"));
        EXPECT_EQ(scene.images.at(0).bytes.at(0), glm::u8vec4(10, 20, 30, 255)) << name;
    }
}

// Files whose work would grow with lines that no face needs.
TEST_F(Ply, ManyTextureFiles) {
    writeFile(folder / "red.png", pngFile(1, 1, 3, {255, 0, 0}));
    writeFile(folder / "blue.png", pngFile(1, 1, 3, {0, 0, 255}));
    const std::string elements = kVertexElement +
                                 "element face 2\nproperty list uchar int vertex_indices\n"
                                 "property list uchar float texcoord\nproperty int texnumber\n";
    const auto body = [](int first, int second) {
        return kVertices + "3 0 1 2 6 0 0 1 0 1 1 " + std::to_string(first) + "\n3 0 2 3 6 0 0 1 1 0 1 " +
               std::to_string(second) + '\n';
    };
    std::string equal;
    for (int i = 0; i < 2000; ++i) {
        equal += "comment TextureFile red.png\ncomment TextureFile blue.png\n";
    }
    const Scene scene = load("a.ply", ascii(equal + elements, body(3998, 3999)));
    EXPECT_EQ(scene.images.size(), 2u);
    EXPECT_EQ(scene.materials.at(scene.triangleMaterial.at(0)).name, "red.png");
    EXPECT_EQ(scene.materials.at(scene.triangleMaterial.at(1)).name, "blue.png");
    std::string different = "comment TextureFile red.png\n";
    for (int i = 0; i < 2000; ++i) {
        different += "comment TextureFile " + std::to_string(i) + ".png\n";
    }
    const Scene many = load("a.ply", ascii(different + elements, body(0, 1500)),
                            {"PLY: there are more than 1000 texture files; the others are not used"});
    EXPECT_EQ(many.materials.at(many.triangleMaterial.at(0)).name, "red.png");
    EXPECT_EQ(many.triangleMaterial.at(1), kNoMaterial);
}

TEST_F(Ply, TexturesThatCannotBeUsed) {
    const std::string texture = "comment TextureFile gone.png\n";
    expectSquare(ascii(texture + kVertexElement + kFaceElement, kVertices + kFace),
                 {"PLY: there are no texture coordinates, so the texture 'gone.png' is not used"});
    const std::string texCoords = "property list uchar float texcoord\n";
    EXPECT_EQ(refused(ascii(texture + kVertexElement + kFaceElement + texCoords,
                            kVertices + "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n")),
              "texture 'gone.png' is missing");
    EXPECT_EQ(refused(ascii("comment TextureFile ..\\gone.png\n" + kVertexElement + kFaceElement + texCoords,
                            kVertices + "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n")),
              "texture '../gone.png' leaves the scene's folder");
}

TEST_F(Ply, TextureComesBeforeColors) {
    writeFile(folder / "t.png", pngFile(1, 1, 3, {10, 20, 30}));
    const std::string header =
        "comment TextureFile t.png\n" + kVertexElement +
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float u\n"
        "property float v\n" +
        kFaceElement;
    const Scene scene = load(
        "a.ply",
        ascii(header, "-1 -1 0 9 9 9 0 0\n1 -1 0 9 9 9 1 0\n1 1 0 9 9 9 1 1\n-1 1 0 9 9 9 0 1\n" + kFace),
        {"PLY: the file has textures, so its colours are not used"});
    EXPECT_TRUE(scene.colors.empty());
}

TEST_F(Ply, PointsAndEdgesAreNoSurface) {
    EXPECT_EQ(refused(ascii(kVertexElement, kVertices)),
              "PLY: there are 4 vertices, but no faces; points and edges are not rendered");
    EXPECT_EQ(refused(ascii(kVertexElement + "element edge 1\nproperty int vertex1\nproperty int vertex2\n",
                            kVertices + "0 1\n")),
              "PLY: there are 4 vertices and 1 edges, but no faces; points and edges are not rendered");
    EXPECT_EQ(refused(ascii(kFaceElement, "0\n")), "PLY: there are no vertices");
    expectSquare(
        ascii(kVertexElement + replaced(kFaceElement, "1", "3"), kVertices + "2 0 1\n" + kFace + "0\n"),
        {"mesh 0: 2 faces with fewer than three corners are not rendered"});
    EXPECT_EQ(refused(ascii(kVertexElement + kFaceElement, kVertices + "2 0 1\n")),
              "there is no triangle in it");
}

TEST_F(Ply, BrokenHeaders) {
    EXPECT_EQ(refused("ply\nformat ascii 1.0\nelement vertex 4\n"), "not PLY, or cut off in its header");
    EXPECT_EQ(refused("ply\nformat ascii 1.0\nend_header"), "not PLY, or cut off in its header");
    const auto line = [this](const std::string& header) { return refused(ascii(header, kVertices + kFace)); };
    EXPECT_EQ(line("element vertex\n"), "PLY header, line 3: element 'vertex' has no count");
    EXPECT_EQ(line("element vertex -1\n"), "PLY header, line 3: element 'vertex' has no count");
    EXPECT_EQ(line("property float x\n"), "PLY header, line 3: a property without a name or element");
    EXPECT_EQ(line("element vertex 4\nproperty real x\n"), "PLY header, line 4: unknown type 'real'");
    EXPECT_EQ(line("propperty float x\n"), "PLY header, line 3: unknown keyword 'propperty'");
    EXPECT_EQ(line(kVertexElement + kVertexElement), "PLY header, line 7: two elements are named 'vertex'");
    EXPECT_EQ(line("element vertex 4000000000\n" + kXyz + kFaceElement),
              "PLY header: the file cannot hold its 4000000000 elements 'vertex'");
    EXPECT_EQ(line("element vertex 4\nproperty float x\nproperty float y\n" + kFaceElement),
              "PLY header: the vertices do not have x, y and z");
    EXPECT_EQ(line(kVertexElement + "element face 1\nproperty list uchar int corners\n"),
              "PLY header: face has no list 'vertex_indices'");
    EXPECT_EQ(refused(replaced(kSquare, "ascii", "packed")), "PLY header, line 2: unknown format 'packed'");
}

TEST_F(Ply, BrokenBodies) {
    const auto body = [this](const std::string& text) {
        return refused(ascii(kVertexElement + kFaceElement, text));
    };
    EXPECT_EQ(body(kVertices + "4 0 1 2\n"), "PLY face 0: the line ends here");
    EXPECT_EQ(body(kVertices), "PLY face 0: the file ends here");
    EXPECT_EQ(body("-1 -1 0\n1 -1\n1 1 0\n-1 1 0\n" + kFace), "PLY vertex 1: the line ends here");
    EXPECT_EQ(body(replaced(kVertices, "1 1 0", "1 one 0") + kFace), "PLY vertex 2: 'one' is not a number");
    EXPECT_EQ(body(kVertices + "-1 0 1 2\n"), "PLY face 0: a list has -1 entries");
    EXPECT_EQ(body(kVertices + "3 0 1 -1\n"),
              "PLY face 0: vertex index -1 is out of range, there are 4 vertices");
    EXPECT_EQ(body(kVertices + "3 0 1 1.5\n"),
              "PLY face 0: vertex index 1.5 is out of range, there are 4 vertices");
    EXPECT_EQ(body(kVertices + "3 0 1 nan\n"),
              "PLY face 0: vertex index nan is out of range, there are 4 vertices");
    EXPECT_EQ(body(kVertices + "1e9 0 1 2\n"), "PLY face 0: the line ends here");
    BinaryText huge(std::endian::little);
    huge.add(kPositions).add<std::uint32_t>({4000000000u, 0, 1, 2});
    EXPECT_EQ(
        refused(binary(std::endian::little,
                       kVertexElement + "element face 1\nproperty list uint int vertex_indices\n", huge)),
        "PLY face 0: the file ends here");
}

// Programs that read words without regard to lines write such files too.
TEST_F(Ply, ElementsOnWrongLines) {
    const std::vector<std::string> warning = {"PLY: the elements are not each on a line of their own"};
    const std::string header = kVertexElement + kFaceElement;
    expectSquare(ascii(header, "-1 -1 0 1 -1 0 1 1 0 -1 1 0 4 0 1 2 3"), warning);
    expectSquare(ascii(header, "-1\n-1\n0\n1\n-1\n0\n1\n1\n0\n-1\n1\n0\n4\n0\n1\n2\n3\n"), warning);
    expectSquare(ascii(header, kVertices + "4 0 1\n2 3\n"), warning);
    expectSquare(ascii(header, "-1 -1 0 0.5\n1 -1 0 0.5\n1 1 0\n-1 1 0\n" + kFace),
                 {"PLY: 2 lines have more numbers than their elements; these are not read"});
    // One word too many or too few cannot be told from a file whose numbers have moved.
    EXPECT_EQ(refused(ascii(header, "-1 -1 0 1 -1 0 1 1 0 -1 1 0 4 0 1 2 3 4")),
              "PLY vertex 1: the file ends here");
    EXPECT_EQ(refused(ascii(header, "-1 -1 0 1 -1 0 1 1 0 -1 1 0 4 0 1 2")),
              "PLY vertex 1: the file ends here");
}

TEST_F(Ply, UnusedVertexThatIsNotFinite) {
    const std::string header = replaced(kVertexElement, "4", "5") + kFaceElement;
    expectSquare(ascii(header, kVertices + "nan 1.#QNAN 1e400\n" + kFace),
                 {"mesh 0: 1 positions of vertices that no triangle uses are not finite; zero is used"});
    EXPECT_EQ(refused(ascii(header, kVertices + "nan 0 0\n4 0 1 2 4\n")),
              "mesh 0: position of vertex 4 is not finite");
}

} // namespace
} // namespace metamarch
