// SPDX-License-Identifier: MIT
// Scenes with few triangles or none.
#include "fixtures/expect_error.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamarch::tests {
namespace {

// Expects one empty leaf in a lattice of one cell.
void expectNothing(const AccelerationStructure& structure) {
    EXPECT_EQ(structure.lattice.resolution, glm::uvec3(1));
    EXPECT_EQ(structure.lattice.triangleCount, 0u);
    ASSERT_EQ(structure.tree.nodes.size(), 1u);
    EXPECT_TRUE(isLeaf(structure.tree.nodes[0]));
    ASSERT_EQ(structure.tree.leaves.size(), 1u);
    EXPECT_EQ(structure.tree.leaves[0].triangleCount, 0u);
    EXPECT_EQ(structure.table.words, std::vector<std::uint32_t>(4, 0));
    EXPECT_TRUE(structure.tree.leafTriangles.empty());
    EXPECT_TRUE(structure.triangles.empty());
}

const AccelerationOptions kOptions[] = {
    {},
    {glm::dvec3(0.002), {}, {}},
    {{}, 1000000u, 16u},
    {{}, {}, 0u},
};

TEST(AccelerationStructure, ofAnEmptyScene) {
    for (const AccelerationOptions& options : kOptions) {
        const AccelerationStructure structure = buildAccelerationStructure({}, options);
        expectNothing(structure);
        EXPECT_EQ(structure.degenerateTriangles, 0u);
    }
}

TEST(AccelerationStructure, ofDegenerateTrianglesOnly) {
    Scene points;
    addTriangle(points, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    Scene segments;
    addTriangle(segments, {0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    addTriangle(segments, {5, 0, 0}, {5, 0, 0}, {6, 0, 0});
    // Its area underflows in single precision.
    addTriangle(segments, {0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0});
    for (const AccelerationOptions& options : kOptions) {
        const AccelerationStructure structure = buildAccelerationStructure(segments, options);
        expectNothing(structure);
        EXPECT_EQ(structure.degenerateTriangles, 3u);
        expectNothing(buildAccelerationStructure(points, options));
    }
}

TEST(AccelerationStructure, leavesDegenerateTrianglesOut) {
    Scene scene = unitCube();
    const auto nonDegenerate = static_cast<std::uint32_t>(scene.triangles.size());
    addTriangle(scene, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f});
    addTriangle(scene, {0, 0, 0}, {0.5f, 0.5f, 0.5f}, {1, 1, 1});
    addTriangle(scene, {0, 0, 0.5f}, {1, 0, 0.5f}, {0, 1, 0.5f});
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    EXPECT_EQ(structure.degenerateTriangles, 2u);
    EXPECT_EQ(structure.lattice.triangleCount, nonDegenerate + 1);
    const std::vector<std::uint32_t>& listed = structure.tree.leafTriangles;
    for (const std::uint32_t degenerate : {nonDegenerate, nonDegenerate + 1}) {
        EXPECT_EQ(std::count(listed.begin(), listed.end(), degenerate), 0);
    }
    EXPECT_GT(std::count(listed.begin(), listed.end(), nonDegenerate + 2), 0);
}

TEST(AccelerationStructure, refusesADepthOverTheLimit) {
    expectError(ErrorKind::invalidArgument, "a tree depth of 49 is over the limit of 48", {"treeDepth"}, [] {
        buildAccelerationStructure(unitCube(), {{}, {}, kMaxTreeDepth + 1});
    });
}

} // namespace
} // namespace metamarch::tests
