// SPDX-License-Identifier: MIT
// OBJ as programs write it.
#include "scene/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace metamarch {
namespace {

const std::string kVertices = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
const std::string kSquare = kVertices + "f 1 2 3 4\n";

class Obj : public MeshFileTest {
  protected:
    Scene load(const std::string& content, const std::vector<std::string>& warnings = {}) {
        return MeshFileTest::load("a.obj", content, warnings);
    }

    std::string refusal(const std::string& content) { return MeshFileTest::refusal("a.obj", content); }

    double area(const std::string& content) { return frontAreaOf(load(content)); }

    // The base colour of the first triangle.
    glm::vec3 color(const std::string& content, const std::vector<std::string>& warnings = {}) {
        const Scene scene = load(content, warnings);
        const std::uint32_t material = scene.triangleMaterial.at(0);
        return material == kNoMaterial ? glm::vec3(NAN)
                                       : glm::vec3(scene.materials[material].baseColorFactor);
    }
};

constexpr glm::vec3 kRed(1.0f, 0.0f, 0.0f);

TEST_F(Obj, MarkOfByteOrder) {
    writeFile(folder / "colours.mtl", "\xef\xbb\xbfnewmtl x\nKd 1 0 0\n");
    EXPECT_EQ(color("\xef\xbb\xbfmtllib colours.mtl\n" + kVertices + "usemtl x\nf 1 2 3 4\n"), kRed);
}

TEST_F(Obj, CommentsBehindData) {
    EXPECT_EQ(area("v -1 -1 0 # one\nv 1 -1 0# two\nv 1 1 0 #\nv -1 1 0\nvt 0 0 # none\nvn 0 0 1 # up\n"
                   "f 1/1/1 2/1/1 3/1/1 4/1/1# a quad\n$ by Viewpoint\n  # the end"),
              4.0);
}

TEST_F(Obj, ConcavePolygonsKeepTheirArea) {
    EXPECT_EQ(area("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv 0 0 0\nv -1 1 0\nf 1 2 3 4 5\n"), 3.0);
    EXPECT_EQ(area("v 0 0 0\nv 2 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5 6\n"), 10.0);
}

TEST_F(Obj, Numbers) {
    EXPECT_EQ(area("v -1. -1.0 .0\nv +1 -1 -.0\nv 1E0 10e-1 0.\nv -1 1 0\nf 1 2 3 4\n"), 4.0);
    EXPECT_EQ(refusal("v 0 0 zero\n" + kSquare), "line 1: 'zero' is not a number");
    EXPECT_EQ(refusal(kSquare + "v 1,5 0 0\n"), "line 6: '1,5' is not a number");
    EXPECT_EQ(refusal(kSquare + "\n\nv 1 2\n"), "line 8: there are 2 numbers in place of 3");
    EXPECT_EQ(refusal(kSquare + "vn 1 2\n"), "line 6: there are 2 numbers in place of 3");
    EXPECT_EQ(refusal(kSquare + "v " + std::string(10000, 'x') + " 0 0\n"),
              "line 6: '" + std::string(40, 'x') + "...' is not a number");
}

// As older C libraries of Microsoft print them.
TEST_F(Obj, NumbersThatAreNotFinite) {
    EXPECT_EQ(area("vn -1.#IND00 1.#QNAN 1.#INF # broken\n" + kSquare), 4.0);
    EXPECT_EQ(refusal(kVertices + "v 0 1 1.#QNAN\nf 1 2 5\n"), "mesh 0: position of vertex 4 is not finite");
}

TEST_F(Obj, LinesAndBlanks) {
    EXPECT_EQ(area("  v\t-1 -1\t\t0  \n\tv 1 -1 0\n\n   \nv  1 1 0\nv -1 1 0\n f  1 2 3  4 \n"), 4.0);
    std::string returns = kSquare;
    std::ranges::replace(returns, '\n', '\r');
    EXPECT_EQ(area(returns), 4.0);
    EXPECT_EQ(area("v -1 -1 0\r\nv 1 -1 0\r\nv 1 1 0\r\nv -1 1 0\r\nf 1 2 3 4"), 4.0);
    EXPECT_EQ(area("v -1 -1 \\\n0\nv 1 -1 \\\r\n0\nv 1 \\  \n1 \\\n 0\nv -1 1 0\nf 1 2 \\\n3 4\n"), 4.0);
    // No comment goes on, and lines keep their numbers.
    EXPECT_EQ(area("# saved in C:\\models\\\n" + kSquare), 4.0);
    EXPECT_EQ(area(kVertices + "f 1 2 3 # made in C:\\models\\\nf 1 3 4\n"), 4.0);
    EXPECT_EQ(area("v -1 -1 0 # C:\\\n" + kSquare.substr(10)), 4.0);
    EXPECT_EQ(refusal(kVertices + "f 1 2 \\\n 3 4\nf 1 2 9\n"),
              "line 7: vertex index 9 is out of range, there are 4");
}

TEST_F(Obj, Indices) {
    EXPECT_EQ(area(kVertices + "f -4 -3 -2 -1\nv 9 9 9\n"), 4.0);
    EXPECT_EQ(area(kVertices + "f 1/ 2/ 3// 4//\n"), 4.0);
    EXPECT_EQ(area("f 1 2 3 4\n" + kVertices), 4.0);
    EXPECT_EQ(area(kVertices + "fo 1 2 3 4\n"), 4.0);
    EXPECT_EQ(refusal(kVertices + "f 0 1 2\n"), "line 5: vertex index 0: indices count from 1");
    EXPECT_EQ(refusal(kVertices + "f 1 2 3\nf 1 2 -5\nv 0 0 0\n"),
              "line 6: vertex index -5 is out of range, there are 4 before it");
    EXPECT_EQ(refusal(kVertices + "f 1 2 4294967297\n"),
              "line 5: vertex index 4294967297 is out of range, there are 4");
    EXPECT_EQ(refusal(kVertices + "vt 0 0\nf 1/1 2/1 3/2\n"),
              "line 6: texture coordinate index 2 is out of range, there are 1");
    EXPECT_EQ(refusal(kVertices + "f 1 2 3.5\n"), "line 5: '3.5' is not an index");
    EXPECT_EQ(refusal(kVertices + "f 1/1/1/1 2 3\n"), "line 5: '1/1/1/1' is not a corner of a face");
    EXPECT_EQ(refusal(kVertices + "f /1 2 3\n"), "line 5: '/1' is not a corner of a face");
}

TEST_F(Obj, TheIndexZeroIsNone) {
    const Scene scene =
        load(kVertices + "vt 0.25 0.75\nvn 0 0 2\nf 1/0/0 2/0/0 3/0/0\nf 1/1/1 3/1/1 4/1/1\n",
             {"3 corners of faces have the texture coordinate index 0, which is taken for none: indices "
              "count from 1",
              "3 corners of faces have the normal index 0, which is taken for none: indices count from 1"});
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.normals[scene.triangles[0].x], glm::vec3(0.0f));
    EXPECT_EQ(scene.normals[scene.triangles[1].x], glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.texCoords[scene.triangles[1].x], glm::vec2(0.25f, 0.25f));
    EXPECT_EQ(areaOf(load(kVertices + "vt 0 0\nf 1/0 2/0 3/0 4/0\n",
                          {"4 corners of faces have the texture coordinate index 0, which is taken for none: "
                           "indices count from 1"})),
              4.0);
}

TEST_F(Obj, IndicesOfWhatIsNotThereAreIgnored) {
    const Scene scene =
        load(kVertices + "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n",
             {"faces have indices of texture coordinates, but there are none in the file; they are "
              "ignored"});
    EXPECT_EQ(areaOf(scene), 4.0);
    EXPECT_EQ(scene.normals.at(0), glm::vec3(0, 0, 1));
    EXPECT_EQ(
        areaOf(load(kVertices + "f 1//-1 2//0 3//9 4\n",
                    {"faces have indices of normals, but there are none in the file; they are ignored"})),
        4.0);
}

TEST_F(Obj, WhatNoFaceUsesIsLeftOut) {
    const Scene scene = load("vt 1 1\nvn 0 1 0\n" + kSquare);
    EXPECT_EQ(scene.positions.size(), 4u);
    EXPECT_EQ(scene.normals.at(0), glm::vec3(0.0f));
}

TEST_F(Obj, CornersMayHaveNoNormal) {
    const Scene scene = load(kVertices + "vn 0 0 2\nvt 0.25 0.75\nf 1/1 2/1 3/1\nf 1//1 3//1 4//1\n");
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.normals[scene.triangles[0].x], glm::vec3(0.0f));
    EXPECT_EQ(scene.normals[scene.triangles[1].x], glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.texCoords[scene.triangles[0].x], glm::vec2(0.25f, 0.25f));
}

TEST_F(Obj, TheFourthNumberIsAWeight) {
    const Scene scene = load("v -1 -1 0 0.5\nv 1 -1 0 2\nv 1 1 0 1\nv -1 1 0\nf 1 2 3 4\n");
    EXPECT_EQ(areaOf(scene), 4.0);
    EXPECT_TRUE(scene.colors.empty());
}

TEST_F(Obj, VertexColorsAreSrgb) {
    const Scene scene =
        load("v -1 -1 0 1 0 0\nv 1 -1 0 0.5 0.5 0.5\nv 1 1 0 0 0 1 0.25\nv -1 1 0\nf 1 2 3 4\n");
    ASSERT_EQ(scene.colors.size(), 4u);
    EXPECT_EQ(scene.colors[0], glm::vec4(1, 0, 0, 1));
    EXPECT_NEAR(scene.colors[1].r, std::pow((0.5 + 0.055) / 1.055, 2.4), 1e-6);
    EXPECT_EQ(scene.colors[2], glm::vec4(0, 0, 1, 0.25f));
    EXPECT_EQ(scene.colors[3], glm::vec4(1.0f));
    const Material& material = scene.materials.at(scene.triangleMaterial.at(0));
    EXPECT_EQ(glm::vec3(material.baseColorFactor), glm::vec3(1.0f));
    EXPECT_EQ(material.metallicFactor, 0.0f);
    EXPECT_EQ(load("v 0 0 0\nv 1 0 0 1.0000001 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n").colors.at(1).r, 1.0f);
    EXPECT_EQ(load("v 0 0 0\nv 1 0 0 255 0 51\nv 0 1 0 0 0 0\nf 1 2 3\n").colors.at(1).r, 1.0f);
}

TEST_F(Obj, NamesHaveBlanks) {
    writeFile(folder / "my colours.mtl",
              "newmtl dark red  \nKd 1 0 0\nnewmtl Material #25 # shiny\nKd 0 1 0\n");
    writeFile(folder / "more.mtl", "newmtl blue\nKd 0 0 1\n");
    const std::string libraries = "mtllib my colours.mtl more.mtl \t\n" + kVertices;
    EXPECT_EQ(color(libraries + "usemtl dark red\t \nf 1 2 3 4\n"), kRed);
    EXPECT_EQ(color(libraries + "usemtl Material #25\nf 1 2 3 4\n"), glm::vec3(0, 1, 0));
    EXPECT_EQ(color(libraries + "usemtl blue # not red\nf 1 2 3 4\n"), glm::vec3(0, 0, 1));
    EXPECT_EQ(color("mtllib \"my colours.mtl\" \"more.mtl\"\n" + kVertices + "usemtl blue\nf 1 2 3 4\n"),
              glm::vec3(0, 0, 1));
    EXPECT_EQ(color("mtllib my colours.mtl # mine\n" + kVertices + "usemtl dark red\nf 1 2 3 4\n"), kRed);
    const Scene scene = load("o left hand \n" + kSquare);
    EXPECT_EQ(scene.meshes.at(0).name, "left hand");
}

TEST_F(Obj, SeveralLibraries) {
    writeFile(folder / "a.mtl", "newmtl x\nKd 0 1 0\n");
    writeFile(folder / "b.MTL", "newmtl y\nKd 1 0 0\n");
    EXPECT_EQ(color("mtllib a.mtl\nmtllib .\\b.MTL\nmtllib ./a.mtl\n" + kVertices + "usemtl y\nf 1 2 3 4\n"),
              kRed);
    const std::string both = kVertices + "usemtl y\nf 1 2 3\nusemtl x\nf 1 3 4\n";
    EXPECT_EQ(load("mtllib a.mtl b.MTL a.mtl\n" + both).materials.size(), 2u);
    EXPECT_TRUE(load("mtllib a.mtl b.MTL\n" + kSquare).materials.empty()); // no face uses one
    // By the last part of a name from another machine, and by the OBJ's name.
    EXPECT_EQ(color("mtllib C:\\Users\\me\\b.MTL\n" + kVertices + "usemtl y\nf 1 2 3 4\n"), kRed);
    const std::string renamed = "mtllib old.mtl\n" + kVertices + "usemtl x\nf 1 2 3 4\n";
    EXPECT_EQ(color(renamed, {"material library 'old.mtl' is missing; 'a.mtl' is read in its place"}),
              glm::vec3(0, 1, 0));
}

TEST_F(Obj, MissingMaterialsAreNamed) {
    writeFile(folder / "a.mtl", "newmtl x\nKd 0 1 0\n");
    const Scene scene =
        load("mtllib a.mtl\n" + kVertices + "usemtl y\nf 1 2 3\nusemtl\nf 1 2 3\nusemtl x\nf 1 3 4\n",
             {"no material library has the materials y"});
    EXPECT_EQ(scene.triangleMaterial.at(0), kNoMaterial);
    std::string many = kSquare;
    for (int i = 0; i < 10; ++i) {
        many += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
    }
    load(many, {"no material library has the materials m0, m1, m2, m3, m4, m5, m6, m7 and 2 more"});
}

TEST_F(Obj, WhatIsNotRenderedIsNamedOnce) {
    load(kSquare + "l 1 2 3\nl 1 2\np 1\nvp 0.5\ncstype bspline\ndeg 3\ncurv 0 1 1 2 3 4\nend\n",
         {"2 lines, 1 point elements, 5 free-form statements (vp, cstype, deg, curv, end) are not rendered"});
    load(kSquare + "s 1\ns off\nlod 3\nmg 0\nbevel on\nusemap wood\nusemap rock\n",
         {"the keywords usemap are not known and are skipped"});
    load(kSquare + "f 1 2\nf 1\nf\n", {"mesh 0: 3 faces with fewer than three corners are not rendered"});
    load(kSquare + "f 1 2\n", {"mesh 0: 1 face with fewer than three corners is not rendered"});
    std::string groups = kSquare;
    for (int i = 0; i < 10; ++i) {
        groups += "o g" + std::to_string(i) + "\nf 1 2\n";
    }
    load(
        groups,
        {"mesh 'g0', mesh 'g1', mesh 'g2', mesh 'g3', mesh 'g4', mesh 'g5', mesh 'g6', mesh 'g7' and 2 more: "
         "10 faces with fewer than three corners are not rendered"});
}

// The polygon of Triangulate.SaysWhenTheWorkRunsOut.
TEST_F(Obj, FacesThatAreNotDividedExactlyAreNamed) {
    std::string content;
    std::string face = "f";
    constexpr int kSize = 4000;
    for (int i = 0; i < 2 * kSize; ++i) {
        const double angle = std::numbers::pi / kSize * (i < kSize ? -(kSize - 1) * i : 10 * (i - kSize));
        const double radius = i < kSize ? 100.0 : 90.0;
        content += "v " + std::to_string(radius * std::cos(angle)) + ' ' +
                   std::to_string(radius * std::sin(angle)) + " 0\n";
        face += ' ' + std::to_string(i + 1);
    }
    load(content + face + "\n",
         {"mesh 0: 1 face with very many corners is not divided exactly: parts may be missing or stand out"});
}

TEST_F(Obj, GroupsAreMeshes) {
    const Scene scene = load(kVertices + "f 1 2 3\ng a\nf 1 2 3\ng b c\nf 1 2 3\ng a\nf 1 3 4\no d\n");
    ASSERT_EQ(scene.meshes.size(), 3u);
    EXPECT_EQ(scene.meshes[0].name, "");
    EXPECT_EQ(scene.meshes[1].name, "a");
    EXPECT_EQ(scene.meshes[2].name, "b c");
    EXPECT_EQ(std::ranges::count(scene.triangleMesh, 1u), 2);
}

// Files whose work would grow faster than their size.
TEST_F(Obj, ManyLibraries) {
    std::string names;
    for (int i = 0; i < 100000; ++i) {
        names += "mtllib " + std::to_string(i % 3) + ".mtl " + std::to_string(i) + ".mtl\n";
    }
    writeFile(folder / "a.obj", kSquare + names);
    EXPECT_EQ(loadScene(folder / "a.obj").warnings.size(), 1001u);
}

TEST_F(Obj, LongLinesTakeTheirLengthInTime) {
    std::string names = "mtllib";
    std::string corners = "f";
    std::string joined = "f 1 2 3 ";
    for (int i = 0; i < 100000; ++i) {
        names += " a";
        corners += " 1 2 3 4";
        joined += "\\\n4 ";
    }
    const std::string a = names.substr(7, 40); // the beginning of the name that is no file's
    load(kSquare + names + '\n' + corners + '\n' + joined + '\n',
         {"material library '" + a + "...' has too long a name and is not read"});
}

} // namespace
} // namespace metamarch
