// SPDX-License-Identifier: MIT
// A ray leaves a tested leaf through its exit box, so every triangle in that box must have been tested.
#include "accel/overlap.h"
#include "fixtures/named_scene.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/exit_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamarch::tests {
namespace {

Scene sphereOnPlane() { return sphereOnFloor(24, 12, 100.0f); }

const NamedScene kCases[] = {
    {"empty", noTriangles, {}},
    {"unit_cube_integer_planes", unitCube, {glm::dvec3(0.125), {}, {}}},
    {"soup", [] { return triangleSoup(600, 1); }, {}},
    {"soup_anisotropic", [] { return triangleSoup(600, 1); }, {glm::dvec3(0.01, 0.3, 0.05), {}, {}}},
    {"sphere_on_plane", sphereOnPlane, {}},
};

class ExitBoxes : public testing::TestWithParam<NamedScene> {
  protected:
    const Scene scene = GetParam().make();
    const AccelerationStructure structure = buildAccelerationStructure(scene, GetParam().options);
    const std::vector<Leaf>& leaves = structure.tree.leaves;
    const std::vector<Leaf>& grown = structure.table.leaves;

    std::span<const std::uint32_t> trianglesOf(const Leaf& leaf) const {
        return structure.tree.trianglesOf(leaf);
    }

    // Returns true if all leaves with a cell in the box list only triangles that `leaf` lists too.
    bool holdsAllIn(const Leaf& leaf, const CellBox& box) const {
        for (ivec3 cell = box.lo; cell.z < box.hi.z; ++cell.z) {
            for (cell.y = box.lo.y; cell.y < box.hi.y; ++cell.y) {
                for (cell.x = box.lo.x; cell.x < box.hi.x; ++cell.x) {
                    const Leaf& other = leaves[structure.table.leafAt(cell)];
                    if (!std::ranges::includes(trianglesOf(leaf), trianglesOf(other))) {
                        return false;
                    }
                }
            }
        }
        return true;
    }
};

TEST_P(ExitBoxes, holdTheirLeaves) {
    ASSERT_EQ(grown.size(), leaves.size());
    for (std::size_t leafId = 0; leafId < leaves.size(); ++leafId) {
        const CellBox own = boxOf(leaves[leafId]);
        const CellBox exit = boxOf(grown[leafId]);
        ASSERT_TRUE(glm::all(glm::lessThanEqual(exit.lo, own.lo)));
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(exit.hi, own.hi)));
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(exit.lo, ivec3(0))));
        ASSERT_TRUE(glm::all(glm::lessThanEqual(exit.hi, ivec3(structure.lattice.resolution))));
        EXPECT_EQ(grown[leafId].firstTriangle, leaves[leafId].firstTriangle);
        EXPECT_EQ(grown[leafId].triangleCount, leaves[leafId].triangleCount);
    }
}

// Checked by the overlap test, which knows neither clipping nor leaves.
TEST_P(ExitBoxes, meetNoTriangleThatTheirLeavesLack) {
    const glm::dvec3 margin = referenceMargin(structure.lattice) * (1.0 - kMarginRounding);
    for (const std::uint32_t id : nonDegenerateTriangles(scene)) {
        LatticeTriangle triangle;
        for (int corner = 0; corner < 3; ++corner) {
            triangle[static_cast<std::size_t>(corner)] =
                toLattice(structure.lattice, scene.positions[scene.triangles[id][corner]]);
        }
        for (const Leaf& leaf : grown) {
            const CellBox exit = boxOf(leaf);
            ASSERT_TRUE(std::ranges::binary_search(trianglesOf(leaf), id) ||
                        !overlaps(triangle, {glm::dvec3(exit.lo) - margin, glm::dvec3(exit.hi) + margin}))
                << "triangle " << id << " comes near the exit box of leaf " << &leaf - grown.data();
        }
    }
}

// No face can move farther: one more layer would contain a triangle that the leaf lacks, or leave the
// lattice.
TEST_P(ExitBoxes, reachAsFarAsTheyMay) {
    const ivec3 resolution(structure.lattice.resolution);
    for (const Leaf& leaf : grown) {
        const CellBox exit = boxOf(leaf);
        ASSERT_TRUE(holdsAllIn(leaf, exit));
        for (int axis = 0; axis < 3; ++axis) {
            CellBox below = exit;
            below.hi[axis] = exit.lo[axis];
            below.lo[axis] = exit.lo[axis] - 1;
            EXPECT_TRUE(exit.lo[axis] == 0 || !holdsAllIn(leaf, below));
            CellBox above = exit;
            above.lo[axis] = exit.hi[axis];
            above.hi[axis] = exit.hi[axis] + 1;
            EXPECT_TRUE(exit.hi[axis] == resolution[axis] || !holdsAllIn(leaf, above));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExitBoxes, testing::ValuesIn(kCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

Leaf leafOver(const uvec3 lo, const uvec3 hi, const std::uint32_t first, const std::uint32_t count) {
    return {packCell(lo), packCell(hi), first, count};
}

// Five leaves in a row, which list {7}, {}, {7, 9}, {9}, {}.
TEST(ExitBoxRow, endsAtTheFirstTriangleThatIsNotItsOwn) {
    const uvec3 resolution(10, 1, 1);
    const LeafList list{{leafOver({0, 0, 0}, {2, 1, 1}, 0, 1), leafOver({2, 0, 0}, {4, 1, 1}, 1, 0),
                         leafOver({4, 0, 0}, {6, 1, 1}, 1, 2), leafOver({6, 0, 0}, {8, 1, 1}, 3, 1),
                         leafOver({8, 0, 0}, {10, 1, 1}, 4, 0)},
                        {7, 7, 9, 9}};
    MetaTable table = buildMetaTable(resolution, list.leaves);
    growExitBoxes(list, table);
    const std::pair<int, int> expected[] = {{0, 4}, {2, 4}, {0, 10}, {6, 10}, {8, 10}};
    for (std::size_t leafId = 0; leafId < list.leaves.size(); ++leafId) {
        const auto [lo, hi] = boxOf(table.leaves[leafId]);
        EXPECT_EQ(std::pair(lo.x, hi.x), expected[leafId]) << "leaf " << leafId;
    }
}

TEST(ExitBoxOption, leavesTheLeavesTheirOwnBoxes) {
    AccelerationOptions options;
    options.exitBoxes = false;
    const AccelerationStructure structure = buildAccelerationStructure(triangleSoup(600, 1), options);
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(structure.table.leaves)),
                                   std::as_bytes(std::span(structure.tree.leaves))));
}

} // namespace
} // namespace metamarch::tests
