// SPDX-License-Identifier: MIT
// STL: the square that most of these files hold has 4 square units and faces +z.
#include "scene/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamarch {
namespace {

const std::vector<glm::vec3> kSquare = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
const std::vector<glm::uvec3> kTriangles = {{0, 1, 2}, {0, 2, 3}};

const std::string kText =
    "solid plate\n"
    "facet normal 0 0 1\nouter loop\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 1 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex -1 -1 0\nvertex 1 1 0\nvertex -1 1 0\nendloop\nendfacet\n"
    "endsolid plate\n";

std::string binary(const std::string& header, const std::vector<std::uint16_t>& attributes = {0, 0}) {
    BinaryText body(std::endian::little);
    body.add<std::uint32_t>({2});
    for (std::size_t i = 0; i < 2; ++i) {
        body.add<float>({0, 0, 1});
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3& position = kSquare[kTriangles[i][corner]];
            body.add<float>({position.x, position.y, position.z});
        }
        body.add<std::uint16_t>({attributes[i]});
    }
    std::string padded = header;
    padded.resize(80, '\0');
    return padded + body.text();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
    return text;
}

float linear(double encoded) {
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

class Stl : public MeshFileTest {
  protected:
    void expectSquare(const std::string& content, const std::vector<std::string>& warnings = {}) {
        const Scene scene = load("a.stl", content, warnings);
        EXPECT_EQ(scene.positions, kSquare) << content.substr(0, 100);
        EXPECT_EQ(scene.triangles, kTriangles) << content.substr(0, 100);
    }
    std::string refused(const std::string& content) { return refusal("a.stl", content); }
};

TEST_F(Stl, TextInEveryForm) {
    expectSquare(kText);
    std::string upper = kText;
    std::ranges::transform(upper, upper.begin(),
                           [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
    expectSquare(upper);
    expectSquare(replaced(kText, "\n", "\r\n"));
    expectSquare(replaced(kText, "\n", "\r"));
    expectSquare(replaced(kText, "\n", "\n \t"));
    expectSquare("\xef\xbb\xbf\n" + kText);
    expectSquare(replaced(kText, "endsolid plate\n", "endsolid"));
    expectSquare(replaced(kText, "solid plate", "solid facet with a vertex in its name"));
    expectSquare(replaced(kText, "solid plate", "solid"));
    expectSquare(replaced(kText, "normal 0 0 1", "normal nan -nan 1e400"));
    expectSquare(replaced(kText, "vertex -1 -1 0\n", "vertex -1.000000e+00 -1. +0.0\n"));
    // No program needs the lines but for the name.
    expectSquare(replaced(replaced(kText, "\n", " "), "solid plate", "solid plate\n"));
}

TEST_F(Stl, WhatFollowsTheLastSolid) {
    const auto warning = [](std::size_t bytes) {
        return std::vector<std::string>{"STL: " + std::to_string(bytes) +
                                        " bytes after the last 'endsolid' are not read"};
    };
    expectSquare(kText + " \n\t\r\n");
    expectSquare(kText + "\x1a", warning(1)); // the end of a file of CP/M
    expectSquare(kText + "\n" + std::string(92, '\0'), warning(92));
    expectSquare(kText + "made by hand\nsolid ", warning(19));
}

TEST_F(Stl, TextThatIsNotByTheDefinition) {
    expectSquare(replaced(kText, "endsolid plate", "end solid plate"));
    const std::string colored = replaced(kText, "solid plate\nfacet", "solid plate\ncolor 0.5 0 1\nfacet");
    expectSquare(colored, {"STL: 'color', which text does not have by the definition, is skipped 1 times"});
    expectSquare(replaced(colored, "outer loop", "color 1 0 0\nouter loop"),
                 {"STL: 'color', which text does not have by the definition, is skipped 3 times"});
    EXPECT_EQ(refused(replaced(kText, "endsolid", "end")),
              "STL line 16, facet 2: 'end' is neither 'facet' nor 'endsolid'");
    EXPECT_EQ(refused(replaced(kText, "solid plate\nfacet", "solid plate\ncolor red\nfacet")),
              "STL line 2, facet 0: 'red' is not a number");
}

TEST_F(Stl, SolidsAreMeshes) {
    const Scene scene = load("a.stl", kText + replaced(kText, "plate", "second plate"));
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].name, "plate");
    EXPECT_EQ(scene.meshes[1].name, "second plate");
    EXPECT_EQ(scene.positions.size(), 8u); // meshes share no vertices
    EXPECT_EQ(scene.triangleMesh, std::vector<std::uint32_t>({0, 0, 1, 1}));
    EXPECT_DOUBLE_EQ(frontAreaOf(scene), 8.0);
}

TEST_F(Stl, EqualPositionsAreJoined) {
    const Scene scene = load("a.stl", replaced(kText, "vertex 1 1 0", "vertex 1 1 -0"));
    EXPECT_EQ(scene.positions.size(), 4u);
    EXPECT_TRUE(scene.materials.empty());
}

TEST_F(Stl, TextThatIsCutOffOrBroken) {
    EXPECT_EQ(refused(kText.substr(0, kText.find("endsolid"))), "STL text is cut off: there is no endsolid");
    EXPECT_EQ(refused(kText.substr(0, kText.find("endfacet"))), "STL line 7, facet 1: the file ends here");
    EXPECT_EQ(refused(replaced(kText, "vertex 1 -1 0", "vertex 1 -1")),
              "STL line 6, facet 1: 'vertex' is not a number");
    EXPECT_EQ(refused(replaced(kText, "vertex 1 -1 0\n", "")), "STL line 7, facet 1: it has 2 vertices");
    EXPECT_EQ(refused(replaced(kText, "vertex", "vortex")),
              "STL line 4, facet 1: 'vortex' is neither 'vertex' nor 'endfacet'");
    EXPECT_EQ(refused("solid empty\nendsolid empty\n"), "there is no triangle in it");
}

TEST_F(Stl, BinaryInEveryForm) {
    expectSquare(binary("made by hand"));
    expectSquare(binary("solid of a program that does not know the rule"));
    expectSquare(binary(std::string("solid ").append(74, ' ')));
    // three.js#5734: a file of Thingiverse has 92 bytes too many.
    expectSquare(binary("made by hand").append(92, '\0'),
                 {"STL: 92 bytes after the last of 2 facets are not read"});
    expectSquare(binary("solid made by hand") + "\n",
                 {"STL: 1 bytes after the last of 2 facets are not read"});
}

TEST_F(Stl, BinaryThatIsCutOff) {
    const std::string file = binary("made by hand");
    EXPECT_EQ(refused(file.substr(0, file.size() - 1)), "STL: 2 facets need 184 bytes, but the file has 183");
    EXPECT_EQ(refused(binary("solid one").substr(0, 183)),
              "STL: 2 facets need 184 bytes, but the file has 183");
    EXPECT_EQ(refused(file.substr(0, 84)), "STL: 2 facets need 184 bytes, but the file has 84");
    EXPECT_EQ(refused(file.substr(0, 83)), "not STL: neither binary nor a text that starts with 'solid'");
    EXPECT_EQ(refused(std::string(84, '\0')), "STL: the count of facets is 0");
    std::string huge = file;
    std::fill_n(huge.begin() + 80, 4, '\xff');
    EXPECT_EQ(refused(huge), "STL: 4294967295 facets need 214748364834 bytes, but the file has 184");
}

// Red 31, green 15, blue 0 of 31.
TEST_F(Stl, ColorsOfFacets) {
    const glm::vec4 orange(1, linear(15 / 31.0), 0, 1);
    const auto expectNear = [](const glm::vec4& found, const glm::vec4& expected) {
        EXPECT_LT(glm::distance(found, expected), 1e-6f) << found.x << ' ' << found.y << ' ' << found.z;
    };
    // VisCAM and SolidView: bit 15 says that there is a colour, blue is in the low bits.
    const Scene visCam = load("a.stl", binary("", {0x8000 | 31 << 10 | 15 << 5, 0}));
    for (std::size_t corner = 0; corner < 3; ++corner) {
        expectNear(colorOfCorner(visCam, corner), orange);
        expectNear(colorOfCorner(visCam, 3 + corner), glm::vec4(1));
    }
    // Magics: bit 15 says that there is none, red is in the low bits.
    const Scene magics =
        load("a.stl", binary(std::string("COLOR=\x00\xff\x00\xff", 10), {31 | 15 << 5, 0x8000}));
    for (std::size_t corner = 0; corner < 3; ++corner) {
        expectNear(colorOfCorner(magics, corner), orange);
        expectNear(colorOfCorner(magics, 3 + corner), glm::vec4(0, 1, 0, 1));
    }
    // Attributes that are no colours.
    EXPECT_TRUE(load("a.stl", binary("", {0x8000 | 31, 7})).colors.empty());
    EXPECT_TRUE(load("a.stl", binary("", {1, 2})).colors.empty());
}

} // namespace
} // namespace metamarch
