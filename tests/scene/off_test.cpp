// SPDX-License-Identifier: MIT
// OFF: the square that most of these files hold has 4 square units and faces +z.
#include "scene/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamarch {
namespace {

const std::string kVertices = "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n";
const std::string kFace = "4 0 1 2 3\n";

float linear(double encoded) {
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

// Appends `rest` to each vertex.
std::string verticesWith(const std::string& rest) {
    return "-1 -1 0 " + rest + "\n1 -1 0 " + rest + "\n1 1 0 " + rest + "\n-1 1 0 " + rest + '\n';
}

class Off : public MeshFileTest {
  protected:
    Scene expectSquare(const std::string& content, const std::vector<std::string>& warnings = {}) {
        Scene scene = load("a.off", content, warnings);
        EXPECT_DOUBLE_EQ(areaOf(scene), 4.0) << content;
        EXPECT_DOUBLE_EQ(frontAreaOf(scene), 4.0) << content;
        return scene;
    }
    std::string refused(const std::string& content) { return refusal("a.off", content); }
};

TEST_F(Off, HeadersInEveryForm) {
    for (const char* header :
         {"OFF\n4 1 0\n", "OFF 4 1 0\n", "OFF4 1 0\n", "OFF\n4 1\n", "4 1 0\n", "off\n4 1 4\n",
          "# a\n\nOFF # b\n# c\n4 1 0 # d\n", "OFF\n4\n1\n0\n", "\xef\xbb\xbfOFF\r\n4 1 0\r\n"}) {
        expectSquare(std::string(header).append(kVertices).append(kFace));
    }
}

TEST_F(Off, CommentsAnywhere) {
    expectSquare("OFF\n4 1 0\n# a\n-1 -1 0 # b\n\n1 -1 0#c\n1 1 0\n-1 1 0\n  # d\n4 0 1 2 3 # e\n# f");
}

TEST_F(Off, EveryPrefix) {
    const Scene normals = expectSquare("NOFF\n4 1 0\n" + verticesWith("0 0 2") + kFace);
    EXPECT_EQ(normals.normals.at(3), glm::vec3(0, 0, 1));
    const Scene texCoords = expectSquare("STOFF\n4 1 0\n" + verticesWith("0.5 0.25") + kFace);
    EXPECT_EQ(texCoords.texCoords.at(3), glm::vec2(0.5f, 0.75f)); // v points up
    const Scene colors = expectSquare("COFF\n4 1 0\n" + verticesWith("255 0 0 255") + kFace);
    EXPECT_EQ(colors.colors.at(3), glm::vec4(1, 0, 0, 1));
    const Scene all =
        expectSquare("STCN4OFF\n4 1 0\n-2 -2 0 2 0 0 1 0 0 1 1 0.5 0.25\n2 -2 0 2 0 0 1 0 0 1 1 0.5 0.25\n"
                     "1 1 0 1 0 0 1 0 0 1 1 0.5 0.25\n-1 1 0 1 0 0 1 0 0 1 1 0.5 0.25\n" +
                     kFace);
    EXPECT_EQ(all.normals.at(0), glm::vec3(0, 0, 1));
    EXPECT_EQ(all.colors.at(0), glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(all.texCoords.at(0), glm::vec2(0.5f, 0.75f));
    expectSquare("NCOFF\n4 1 0\n" + verticesWith("0 0 1 128 128 128") + kFace); // MeshLab's order of letters
    expectSquare("nOFF\n3\n4 1 0\n" + kVertices + kFace);
    expectSquare("nOFF 3\n4 1 0\n" + kVertices + kFace);
    expectSquare("4nOFF\n3\n4 1 0\n" + verticesWith("1") + kFace);
    EXPECT_EQ(refused("nOFF\n4\n4 1 0\n" + verticesWith("0") + kFace),
              "OFF: vertices have 4 dimensions instead of 3");
    EXPECT_EQ(refused("XOFF\n4 1 0\n" + kVertices + kFace), "not OFF: does not start with 'OFF'");
    EXPECT_EQ(refused("CCOFF\n4 1 0\n" + kVertices + kFace), "not OFF: does not start with 'OFF'");
}

TEST_F(Off, VertexColors) {
    const auto color = [this](const std::string& prefix, const std::string& numbers) {
        return expectSquare(prefix + "OFF\n4 1 0\n" + verticesWith(numbers) + kFace).colors.at(0);
    };
    EXPECT_EQ(color("C", "128 0 255 255"), glm::vec4(linear(128 / 255.0), 0, 1, 1));
    EXPECT_EQ(color("C", "0.5 0.0 1.0 1.0"), glm::vec4(linear(0.5), 0, 1, 1));
    EXPECT_EQ(color("C", "0.5 0 1"), glm::vec4(linear(0.5), 0, 1, 1));
    EXPECT_EQ(color("C", "1 0 0 1"), glm::vec4(1, 0, 0, 1)); // red, not almost black
    EXPECT_EQ(color("C", "255 0 0 1"), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(color("C", "1.00001 0.0 0.0 1.00001"), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(color("C", "1.5 0.5 0.0"), glm::vec4(1, linear(0.5), 0, 1));
    EXPECT_FLOAT_EQ(color("C", "255 0 0 51").a, 0.2f);
    EXPECT_EQ(refused("COFF\n4 1 0\n" + verticesWith("1 0") + kFace),
              "OFF vertex 0: a colour has 2 numbers instead of 3 or 4");
}

// Some programs write colours without a C in the first line, others normals without an N.
TEST_F(Off, NumbersThatAreNotAnnounced) {
    const auto square = [](const std::string& first, const std::string& others) {
        return "OFF\n4 1 0\n-1 -1 0 " + first + "\n1 -1 0 " + others + "\n1 1 0 " + others + "\n-1 1 0 " +
               others + '\n' + kFace;
    };
    EXPECT_EQ(expectSquare(square("255 0 0", "0 0 7")).colors.at(0), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(expectSquare(square("255 0 0 255", "0 0 7 255")).colors.at(0), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(expectSquare(square("1.0 0.5 0", "0 0 0")).colors.at(0), glm::vec4(1, linear(0.5), 0, 1));
    const std::vector<std::string> warning = {
        "OFF: 4 vertices have more numbers than the first line says; these are not read"};
    for (const char* others : {"0 0 -1", "0.6 -0.8 0", "300 0 0", "7.5 0 0", "nan 0 0"}) {
        const Scene scene = expectSquare(square("0 0 1", others), warning);
        EXPECT_TRUE(scene.colors.empty()) << others;
        EXPECT_TRUE(scene.normals.empty() || scene.normals[0] == glm::vec3(0.0f)) << others;
    }
    // Numbers that are dropped do not say what the colours of faces mean.
    const Scene scene =
        load("a.off", "OFF\n3 1 0\n0 0 0 -0.5 0 0\n1 0 0 0.5 0 0\n0 1 0 0.5 0 0\n3 0 1 2 2 0 0\n",
             {"OFF: 3 vertices have more numbers than the first line says; these are not read"});
    EXPECT_EQ(colorOfCorner(scene, 0), glm::vec4(linear(2 / 255.0), 0, 0, 1));
}

TEST_F(Off, FaceColors) {
    const Scene scene =
        load("a.off", "OFF\n4 3 0\n" + kVertices + "3 0 1 2 255 0 0\n3 0 2 3 0 0 255 255\n3 0 1 3\n");
    for (std::size_t corner = 0; corner < 9; ++corner) {
        EXPECT_EQ(colorOfCorner(scene, corner), corner < 3   ? glm::vec4(1, 0, 0, 1)
                                                : corner < 6 ? glm::vec4(0, 0, 1, 1)
                                                             : glm::vec4(1));
    }
    const Scene fractions = load("a.off", "OFF\n4 2 0\n" + kVertices + "3 0 1 2 0.5 0.0 0.0\n3 0 2 3 7\n");
    EXPECT_EQ(colorOfCorner(fractions, 0), glm::vec4(linear(0.5), 0, 0, 1));
    EXPECT_EQ(colorOfCorner(fractions, 3), glm::vec4(1)); // the index of a colour that is not in the file
    EXPECT_TRUE(expectSquare("OFF\n4 1 0\n" + kVertices + "4 0 1 2 3 7\n").colors.empty());
}

TEST_F(Off, WordsWithoutLines) {
    const std::vector<std::string> warning = {
        "OFF: vertices and faces are not each on a line of their own; colours of faces are not read"};
    expectSquare("OFF 4 1 0 -1 -1 0 1 -1 0 1 1 0 -1 1 0 4 0 1 2 3", warning);
    expectSquare("OFF\n4 1 0\n" + kVertices + "4 0 1\n2 3\n", warning);
    EXPECT_EQ(refused("OFF\n4 1 0\n" + kVertices + "4 0 1\n2\n"), "OFF face 0: the line ends here");
    EXPECT_EQ(refused("OFF\n4 1 0\n" + kVertices + "4 0 1\n2 3 4\n"), "OFF face 0: the line ends here");
}

TEST_F(Off, Binary) {
    BinaryText square(std::endian::big);
    square.add<std::int32_t>({4, 1, 0}).add<float>({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    square.add<std::int32_t>({4, 0, 1, 2, 3});
    BinaryText plain = square;
    plain.add<std::int32_t>({0});
    expectSquare("OFF BINARY\n" + plain.text());
    BinaryText colored = square;
    colored.add<std::int32_t>({3}).add<float>({1, 0, 0});
    EXPECT_EQ(colorOfCorner(expectSquare("OFF BINARY\n" + colored.text()), 5), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(refused("OFF BINARY\n" + square.text()), "OFF: the file ends before its last element");
    BinaryText huge(std::endian::big);
    huge.add<std::int32_t>({-1, 1, 0});
    EXPECT_EQ(refused("OFF BINARY\n" + huge.text()),
              "OFF header: the file cannot hold 4294967295 vertices and 1 faces");
}

TEST_F(Off, TrailingBytes) {
    const std::string square = "OFF\n4 1 0\n" + kVertices + kFace;
    expectSquare(square + "\n \t\n# the end\n");
    expectSquare(square + "# edges\n0 1\n1 2\n", {"OFF: 8 bytes after the last face are not read"});
    BinaryText binary(std::endian::big);
    binary.add<std::int32_t>({4, 1, 0}).add<float>({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    binary.add<std::int32_t>({4, 0, 1, 2, 3, 0});
    expectSquare("OFF BINARY\n" + binary.text() + "\n", {"OFF: 1 bytes after the last face are not read"});
}

TEST_F(Off, PointsAreNoSurface) {
    EXPECT_EQ(refused("OFF\n4 0 0\n" + kVertices),
              "OFF: there are 4 vertices, but no faces; points are not rendered");
    EXPECT_EQ(refused("OFF\n4 1 0\n" + kVertices + "2 0 1\n"), "there is no triangle in it");
    expectSquare("OFF\n4 3 0\n" + kVertices + "2 0 1\n0\n" + kFace,
                 {"mesh 0: 2 faces with fewer than three corners are not rendered"});
}

TEST_F(Off, Broken) {
    EXPECT_EQ(refused("OFF\n4000000000 1 0\n" + kVertices + kFace),
              "OFF header: the file cannot hold 4000000000 vertices and 1 faces");
    EXPECT_EQ(refused("OFF\n4 x 0\n" + kVertices + kFace), "OFF header: 'x' is not a count");
    EXPECT_EQ(refused("OFF\n4 -1 0\n" + kVertices + kFace), "OFF header: '-1' is not a count");
    EXPECT_EQ(refused("OFF\n4 1 0\n" + kVertices + "4 0 1 2 -3\n"),
              "OFF face 0: index '-3' is out of range, there are 4 vertices");
    EXPECT_EQ(refused("OFF\n4 1 0\n" + kVertices), "OFF face 0: the file ends here");
    EXPECT_EQ(refused("OFF\n4 1 0\n-1 -1 0\n1 one 0\n1 1 0\n-1 1 0\n" + kFace),
              "OFF vertex 1: 'one' is not a number");
    EXPECT_EQ(refused("OFF\n5 1 0\n" + kVertices + "nan 0 0\n3 0 1 4\n"),
              "mesh 0: position of vertex 4 is not finite");
    EXPECT_EQ(refused("OFF\n5 1 0\n" + kVertices + "0 1 1.#QNAN\n3 0 1 4\n"),
              "mesh 0: position of vertex 4 is not finite");
    expectSquare("OFF\n5 1 0\n" + kVertices + "nan 0 0\n" + kFace,
                 {"mesh 0: 1 positions of vertices that no triangle uses are not finite; zero is used"});
}

} // namespace
} // namespace metamarch
