// SPDX-License-Identifier: MIT
// Other people's files, against the counts in the table of their README.
#include "fixtures/shared_scenes.h"
#include "metamarch/error/error.h"
#include "metamarch/scene/import.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

namespace metamarch {
namespace {

struct Counts {
    std::size_t vertices = 0;
    std::size_t triangles = 0;

    bool operator==(const Counts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Counts& counts) {
    return out << counts.vertices << " vertices, " << counts.triangles << " triangles";
}

// Reads table rows such as "| gltf/Box.glb | 24 | 12 | CC-BY-4.0 |".
std::map<std::string, Counts> table(const std::filesystem::path& folder) {
    std::map<std::string, Counts> rows;
    std::ifstream readme(folder / "README.md");
    for (std::string line; std::getline(readme, line);) {
        std::istringstream cells(line);
        std::string before, file, vertices, triangles;
        std::getline(cells, before, '|');
        std::getline(cells, file, '|');
        std::getline(cells, vertices, '|');
        std::getline(cells, triangles, '|');
        if (std::istringstream number(vertices);
            file.find('/') != std::string::npos && number >> rows[file].vertices) {
            rows[file].triangles = std::stoul(triangles);
        }
    }
    std::map<std::string, Counts> trimmed;
    for (const auto& [file, counts] : rows) {
        trimmed[file.substr(1, file.size() - 2)] = counts;
    }
    return trimmed;
}

// Scenes whose counts rightly differ from the file's.
const std::map<std::string, Counts> kCountsOfScene = {
    // Meshes placed by several nodes are flattened.
    {"gltf/AttenuationTest.glb", {584, 292}},
    {"gltf/NegativeScaleTest.glb", {3958, 7724}},
    {"gltf/TextureTransformTest/TextureTransformTest.gltf", {48, 24}},
    // EXT_mesh_gpu_instancing with 125 instances.
    {"gltf/SimpleInstancing.glb", {3000, 1500}},
    // Only the default scene is loaded.
    {"gltf/MultipleScenes/MultipleScenes.gltf", {4, 2}},
    {"gltf/embedded/MultipleScenes.gltf", {4, 2}},
    // The vertices of points and lines are dropped.
    {"gltf/embedded/MeshPrimitiveModes.gltf", {21, 16}},
    {"gltf/primitive_modes/Mesh_PrimitiveMode_00.gltf", {0, 0}},
    {"gltf/primitive_modes/Mesh_PrimitiveMode_01.gltf", {0, 0}},
    {"gltf/primitive_modes/Mesh_PrimitiveMode_02.gltf", {0, 0}},
    {"gltf/primitive_modes/Mesh_PrimitiveMode_03.gltf", {0, 0}},
    {"gltf/primitive_modes/Mesh_PrimitiveMode_07.gltf", {0, 0}},
    {"gltf/primitive_modes/Mesh_PrimitiveMode_08.gltf", {0, 0}},
    {"gltf/primitive_modes/Mesh_PrimitiveMode_09.gltf", {0, 0}},
    {"gltf/primitive_modes/Mesh_PrimitiveMode_10.gltf", {0, 0}},
    // Vertices that two groups of an OBJ share become two, and those with two texture coordinates or normals.
    {"mesh/sponza_66k.obj", {61032, 66450}},
    {"paper/cow_viewpoint.obj", {3464, 5804}},
};

// The text that the error for each refused file must contain.
const std::map<std::string, std::string> kRefused = {
    {"gltf/malformed/IndexOutOfRange/AllIndicesOutOfRange.gltf",
     "mesh 'Mesh' primitive 0: index 65535 is out of range, there are 24 vertices"},
    {"gltf/malformed/IndexOutOfRange/IndexOutOfRange.gltf",
     "mesh 'Mesh' primitive 0: index 255 is out of range, there are 24 vertices"},
    {"gltf/malformed/RecursiveNodes/RecursiveNodes.gltf",
     "node 0 is reached twice: the nodes form a cycle, or it has two parents"},
};

TEST(SharedScenes, CountsAreThoseOfTheTable) {
    const std::filesystem::path folder = tests::sharedScene("");
    const std::map<std::string, Counts> rows = table(folder);
    EXPECT_GE(rows.size(), 80u);
    for (const auto& [file, counts] : rows) {
        SCOPED_TRACE(file);
        const auto refused = kRefused.find(file);
        try {
            const Scene scene = loadScene(folder / file);
            EXPECT_EQ(refused, kRefused.end());
            const auto special = kCountsOfScene.find(file);
            EXPECT_EQ((Counts{scene.positions.size(), scene.triangles.size()}),
                      special != kCountsOfScene.end() ? special->second : counts);
        } catch (const Error& error) {
            ASSERT_NE(refused, kRefused.end()) << error.what();
            EXPECT_EQ(error.kind, ErrorKind::inputRefused);
            EXPECT_EQ(error.what(), (folder / file).string() + ": " + refused->second);
        }
    }
}

} // namespace
} // namespace metamarch
