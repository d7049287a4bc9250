// SPDX-License-Identifier: MIT
// OBJ, PLY, OFF and STL.
#include "fixtures/expect_error.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/error/error.h"
#include "scene/gltf_file.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

using Triangles = std::vector<glm::uvec3>;

const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPly = kPlyHeader + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 0 1\n3 0 1 2\n";
const std::string kOff = "OFF\n# a comment\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 0 1\n";
const Triangles kTriangles = {{0, 1, 2}, {0, 2, 3}, {0, 0, 1}, {0, 1, 2}};

const std::string kObj = "mtllib a.mtl\no first\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n"
                         "o second\nusemtl lamp\nf 1 1 2\nf 1 2 3\n";

std::string stlFacet(const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
}

const std::string kStl = "solid plate\n" + stlFacet("0 0 0", "1 0 0", "1 1 0") +
                         stlFacet("0 0 0", "1 1 0", "0 1 0") + "endsolid plate\n";

class MeshImport : public testing::Test {
  protected:
    Scene load(const std::string& name, const std::string& content, float scale = 1.0f) {
        writeFile(folder / name, content);
        return loadScene(folder / name, {.scale = scale});
    }

    std::string refusal(const std::string& name, const std::string& content) {
        writeFile(folder / name, content);
        return refusalOf(folder / name);
    }

    TemporaryFolder folder;
};

TEST_F(MeshImport, PlyKeepsVerticesAndDegenerateFaces) {
    const Scene scene = load("a.ply", kPly, 2.0f);
    EXPECT_EQ(scene.positions, std::vector<glm::vec3>({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}));
    EXPECT_EQ(scene.triangles, kTriangles);
    EXPECT_TRUE(scene.materials.empty());
    EXPECT_EQ(scene.triangleMaterial[0], kNoMaterial);
}

TEST_F(MeshImport, OffKeepsVerticesAndDegenerateFaces) {
    const Scene scene = load("a.off", kOff);
    EXPECT_EQ(scene.positions.size(), 4u);
    EXPECT_EQ(scene.triangles, Triangles(kTriangles.begin(), kTriangles.begin() + 3));
}

TEST_F(MeshImport, NegativeScaleKeepsTheFront) {
    EXPECT_EQ(load("a.ply", kPly, -1.0f).triangles[3], glm::uvec3(0, 2, 1));
}

TEST_F(MeshImport, StlJoinsVertices) {
    const Scene scene = load("a.stl", kStl);
    EXPECT_EQ(scene.positions, std::vector<glm::vec3>({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.triangles, Triangles({{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(MeshImport, ObjNamesMaterialsAndJoinedVertices) {
    writeFile(folder / "a.mtl", "newmtl red\nKd 1 0.25 0\nnewmtl lamp\nKd 0 0 0\nKe 2 3 4\n");
    const Scene scene = load("a.obj", kObj);
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].name, "first");
    EXPECT_EQ(scene.meshes[1].name, "second");
    EXPECT_EQ(scene.positions.size(), 4u + 3u); // the meshes share no vertices
    EXPECT_EQ(scene.triangles.size(), 4u);
    ASSERT_EQ(scene.materials.size(), 2u);
    const Material& red = scene.materials[scene.triangleMaterial[0]];
    const Material& lamp = scene.materials[scene.triangleMaterial[3]];
    EXPECT_EQ(red.name, "red");
    EXPECT_EQ(red.baseColorFactor, glm::vec4(1, 0.25f, 0, 1));
    EXPECT_EQ(lamp.emissiveFactor * lamp.emissiveStrength, glm::vec3(2, 3, 4));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(MeshImport, ObjMaterialLibraryStaysInTheFolder) {
    std::filesystem::create_directory(folder / "inner");
    writeFile(folder / "a.mtl", "newmtl red\nKd 1 0 0\n");
    const Scene scene =
        load("inner/a.obj", "mtllib ../a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_NE(scene.warnings[0].find("leaves the scene's folder and is not read"), std::string::npos);
    EXPECT_EQ(scene.triangles.size(), 1u);
}

TEST_F(MeshImport, PositionNotFinite) {
    std::string ply = kPly;
    EXPECT_EQ(refusal("a.ply", ply.replace(ply.find("1 1 0"), 5, "1 nan 0")),
              "mesh 0: position of vertex 2 is not finite");
}

TEST_F(MeshImport, IndexOutOfRange) {
    std::string ply = kPly;
    EXPECT_EQ(refusal("a.ply", ply.replace(ply.find("3 0 0 1"), 7, "3 0 9 1")),
              "PLY face 1: vertex index 9 is out of range, there are 4 vertices");
    std::string off = kOff;
    EXPECT_EQ(refusal("a.off", off.replace(off.find("3 0 0 1"), 7, "3 0 9 1")),
              "OFF face 1: index '9' is out of range, there are 4 vertices");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
              "line 4: vertex index 9 is out of range, there are 3");
}

// A file that is cut off at any byte is refused or read as a smaller file. ASan in the sanitizer build
// detects errors. The last bytes of a text may be white space.
TEST_F(MeshImport, CutOffAnywhere) {
    const auto refusals = [&](const std::string& name, const std::string& content) {
        std::size_t refused = 0;
        for (std::size_t size = 1; size < content.size(); ++size) {
            try {
                load(name, content.substr(0, size));
            } catch (const Error& error) {
                EXPECT_EQ(error.kind, ErrorKind::inputRefused);
                ++refused;
            }
        }
        return refused;
    };
    EXPECT_GE(refusals("a.ply", kPly), kPly.size() - 2);
    EXPECT_GE(refusals("a.off", kOff), kOff.size() - 2);
    EXPECT_GE(refusals("a.stl", kStl), kStl.size() - 8); // behind "endsolid"
    refusals("a.obj", kObj);
}

TEST_F(MeshImport, BinaryPlyCutOff) {
    std::string ply = kPlyHeader;
    ply.replace(ply.find("ascii"), 5, "binary_little_endian");
    ply.replace(ply.find("face 3"), 6, "face 1");
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<std::int32_t> indices = {0, 1, 2};
    ply.append(reinterpret_cast<const char*>(positions.data()), 48);
    ply += '\3';
    ply.append(reinterpret_cast<const char*>(indices.data()), 12);
    EXPECT_EQ(load("a.ply", ply).triangles, Triangles({{0, 1, 2}}));
    EXPECT_EQ(refusal("a.ply", ply.substr(0, ply.size() - 1)), "PLY face 0: the file ends here");
    EXPECT_EQ(refusal("a.ply", ply.substr(0, ply.size() - 20)), "PLY vertex 3: the file ends here");
    ply[ply.size() - 13] = '\0';
    EXPECT_EQ(refusal("a.ply", ply), "there is no triangle in it");
}

TEST_F(MeshImport, ProseIsNoMesh) {
    const std::string prose = "This is a letter to a friend.\nIt says nothing of vertices or faces.\n";
    EXPECT_EQ(refusal("a.obj", prose), "there is no triangle in it");
    EXPECT_EQ(refusal("a.ply", prose), "not PLY: does not start with 'ply'");
    EXPECT_EQ(refusal("a.off", prose), "not OFF: does not start with 'OFF'");
    EXPECT_EQ(refusal("a.stl", prose), "not STL: neither binary nor a text that starts with 'solid'");
    for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
        EXPECT_EQ(refusal(name, ""), "the file is empty");
    }
}

TEST_F(MeshImport, OtherFormatsUnderAMeshEnding) {
    EXPECT_FALSE(refusal("a.obj", R"({"asset":{"version":"2.0"}})").empty());
    EXPECT_FALSE(refusal("a.stl", kPly).empty());
}

TEST_F(MeshImport, HasOneSceneAndNoVariantsOrAnimations) {
    writeFile(folder / "a.off", kOff);
    const Scene scene = loadScene(folder / "a.off", {.scene = "0"});
    EXPECT_EQ(scene.triangles.size(), kTriangles.size() - 1);
    EXPECT_EQ(scene.scenes, std::vector<std::string>({""}));
    expectError(ErrorKind::invalidArgument, "there is no scene main; the file has 0 ''", {"scene"},
                [&] { loadScene(folder / "a.off", {.scene = "main"}); });
    expectError(ErrorKind::invalidArgument, "there is no variant red; the file has none", {"variant"},
                [&] { loadScene(folder / "a.off", {.variant = "red"}); });
    expectError(ErrorKind::invalidArgument, "there is no animation 0; the file has none", {"animation"},
                [&] { loadScene(folder / "a.off", {.animation = "0"}); });
}

TEST_F(MeshImport, ScaleIsFiniteAndNotZero) {
    writeFile(folder / "a.ply", kPly);
    EXPECT_THROW(loadScene(folder / "a.ply", {.scale = 0.0f}), Error);
    EXPECT_THROW(loadScene(folder / "a.ply", {.scale = INFINITY}), Error);
}

} // namespace
} // namespace metamarch
