// SPDX-License-Identifier: MIT
// Every cell names the leaf that holds it, no matter how the table saves memory.
#include "fixtures/expect_error.h"
#include "fixtures/named_scene.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/meta_table.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace metamarch::tests {
namespace {

Leaf leafOver(const glm::uvec3 lo, const glm::uvec3 hi) { return {packCell(lo), packCell(hi), 0, 0}; }

// Returns a table with one word per cell.
std::vector<std::uint32_t> flatTable(const glm::uvec3 resolution, const std::span<const Leaf> leaves) {
    std::vector<std::uint32_t> leafOfCell(std::size_t{resolution.x} * resolution.y * resolution.z);
    for (std::uint32_t leafId = 0; leafId < leaves.size(); ++leafId) {
        const glm::ivec3 lo = unpackCell(leaves[leafId].lo);
        const glm::ivec3 hi = unpackCell(leaves[leafId].hi);
        for (int z = lo.z; z < hi.z; ++z) {
            for (int y = lo.y; y < hi.y; ++y) {
                std::fill_n(leafOfCell.begin() + cellIndex({lo.x, y, z}, resolution), hi.x - lo.x, leafId);
            }
        }
    }
    return leafOfCell;
}

// `leaves` must tile the lattice of the table.
void expectEqualToAFlatOne(const MetaTable& table, const std::span<const Leaf> leaves) {
    const std::vector<std::uint32_t> flat = flatTable(table.resolution, leaves);
    const glm::ivec3 resolution(table.resolution);
    std::size_t different = 0;
    std::size_t index = 0;
    glm::ivec3 cell;
    for (cell.z = 0; cell.z < resolution.z; ++cell.z) {
        for (cell.y = 0; cell.y < resolution.y; ++cell.y) {
            for (cell.x = 0; cell.x < resolution.x; ++cell.x) {
                different += table.leafAt(cell) == flat[index++] ? 0u : 1u;
            }
        }
    }
    EXPECT_EQ(different, 0u);
}

// The paper's figure 11: a partition that no kd-tree can produce.
TEST(MetaTable, takesAPinwheel) {
    const std::vector<Leaf> leaves = {
        leafOver({0, 0, 0}, {2, 1, 2}), leafOver({2, 0, 0}, {3, 2, 2}), leafOver({1, 2, 0}, {3, 3, 2}),
        leafOver({0, 1, 0}, {1, 3, 2}), leafOver({1, 1, 0}, {2, 2, 2}),
    };
    const MetaTable table = buildMetaTable({3, 3, 2}, leaves);
    EXPECT_EQ(table.words.size(), 4u + kBrickCells); // whole loads of four words
    expectEqualToAFlatOne(table, leaves);
}

TEST(MetaTable, reachesTheLastCellOfTheFinestLattice) {
    const std::vector<Leaf> leaves = {leafOver({0, 0, 0}, {1022, 2, 3}),
                                      leafOver({1022, 0, 0}, {1023, 2, 3})};
    expectEqualToAFlatOne(buildMetaTable({1023, 2, 3}, leaves), leaves);
}

// The ends of leaves fall on every place in a brick, and the last brick has every size.
TEST(MetaTable, endsLeavesAnywhereInABrick) {
    for (std::uint32_t side = 1; side <= 2 * kBrickSide + 1; ++side) {
        for (std::uint32_t plane = 1; plane < side; ++plane) {
            const std::vector<Leaf> leaves = {leafOver({0, 0, 0}, {side, plane, 2}),
                                              leafOver({0, plane, 0}, {side, side, 2})};
            SCOPED_TRACE(testing::Message() << plane << " of " << side);
            expectEqualToAFlatOne(buildMetaTable({side, side, 2}, leaves), leaves);
        }
    }
}

TEST(MetaTable, hasOneWordForEachBrickInOneLeaf) {
    const std::vector<Leaf> leaves = {leafOver({0, 0, 0}, {1023, 1023, 1023})};
    const MetaTable table = buildMetaTable(glm::uvec3(1023), leaves);
    EXPECT_EQ(table.words, std::vector<std::uint32_t>(std::size_t{128} * 128 * 128, 0));
}

// A floor: all bricks that it cuts have equal contents.
TEST(MetaTable, keepsEqualBricksOnce) {
    const std::vector<Leaf> leaves = {leafOver({0, 0, 0}, {1023, 1, 1023}),
                                      leafOver({0, 1, 0}, {1023, 200, 1023})};
    const MetaTable table = buildMetaTable({1023, 200, 1023}, leaves);
    EXPECT_EQ(table.words.size(), 128u * 25u * 128u + 4u * kBrickCells); // plus the bricks at its borders
    EXPECT_EQ(table.leafAt({1022, 0, 1022}), 0u);
    EXPECT_EQ(table.leafAt({1022, 1, 1022}), 1u);
}

Scene stadium() { return sphereOnFloor(48, 24, 10000.0f); }

Scene onAFloor() { return sphereOnFloor(100, 50, 10.0f); }

Scene duplicates() {
    Scene scene;
    for (int i = 0; i < 300; ++i) {
        addTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    }
    return scene;
}

AccelerationOptions merged() {
    AccelerationOptions options;
    options.mergeLeaves = true;
    return options;
}

AccelerationOptions byDivisors() {
    AccelerationOptions options;
    options.table = TableMethod::gcd;
    return options;
}

const NamedScene kCases[] = {
    {"empty", noTriangles, {}},
    {"unit_cube", unitCube, {}},
    {"duplicates", duplicates, {}},
    {"soup", [] { return triangleSoup(2000, 6); }, {}},
    {"soup_anisotropic", [] { return triangleSoup(2000, 6); }, {glm::dvec3(0.01, 0.3, 0.05), {}, {}}},
    {"soup_in_one_leaf", [] { return triangleSoup(2000, 6); }, {{}, {}, 0u}},
    {"soup_merged", [] { return triangleSoup(2000, 6); }, merged()},
    {"soup_by_divisors", [] { return triangleSoup(200, 6); }, byDivisors()},
    {"on_a_floor", onAFloor, {}},
    {"stadium", stadium, {}},
};

class MetaTableOf : public testing::TestWithParam<NamedScene> {
  protected:
    const AccelerationStructure structure = buildAccelerationStructure(GetParam().make(), GetParam().options);
};

TEST_P(MetaTableOf, equalsAFlatOne) {
    const std::vector<Leaf>& leaves = structure.tree.leaves;
    const MetaTable own = buildMetaTable(structure.lattice.resolution, leaves);
    expectEqualToAFlatOne(own, leaves);
    if (!structure.options.mergeLeaves) {
        EXPECT_EQ(structure.table.words, own.words);
    }
}

// The table's leaves, merged or not, with their exit boxes.
TEST_P(MetaTableOf, namesLeavesWhoseExitBoxesHoldTheCell) {
    const glm::ivec3 resolution(structure.lattice.resolution);
    glm::ivec3 cell;
    for (cell.z = 0; cell.z < resolution.z; ++cell.z) {
        for (cell.y = 0; cell.y < resolution.y; ++cell.y) {
            for (cell.x = 0; cell.x < resolution.x; ++cell.x) {
                const Leaf& leaf = structure.table.leaves.at(structure.table.leafAt(cell));
                ASSERT_TRUE(glm::all(glm::lessThanEqual(unpackCell(leaf.lo), cell)));
                ASSERT_TRUE(glm::all(glm::lessThan(cell, unpackCell(leaf.hi))));
            }
        }
    }
}

TEST_P(MetaTableOf, takesNoMoreThanAFlatOneAndItsBricks) {
    const glm::uvec3 bricks = bricksAlong(structure.lattice.resolution);
    const std::size_t brickCount = std::size_t{bricks.x} * bricks.y * bricks.z;
    EXPECT_LE(structure.table.words.size(), brickCount * (1 + kBrickCells));
    EXPECT_LE(structure.table.words.size() * sizeof(std::uint32_t), kAutomaticTableBudget);
}

TEST_P(MetaTableOf, doesNotDependOnThreads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(buildAccelerationStructure(GetParam().make(), GetParam().options).table.words,
              structure.table.words);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MetaTableOf, testing::ValuesIn(kCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(MetaTableBudget, isKept) {
    const std::vector<Leaf> leaves = {leafOver({0, 0, 0}, {3, 8, 8}), leafOver({3, 0, 0}, {8, 8, 8})};
    const std::uint64_t bytes = (1u + kBrickCells) * sizeof(std::uint32_t);
    EXPECT_NO_THROW(buildMetaTable(glm::uvec3(8), leaves, bytes));
    EXPECT_THROW(buildMetaTable(glm::uvec3(8), leaves, bytes - 1), TableOverBudget);
    expectError(ErrorKind::outOfMemory, "choose a smaller tree depth or fewer cells", {"treeDepth", "cells"},
                [&] { buildMetaTable(glm::uvec3(8), leaves, bytes - 1); });
}

// Tiny triangles all over a box: leaves end in every brick.
Scene motes(const std::uint32_t count) {
    Scene scene;
    for (const Scene soup = triangleSoup(count, 9); const glm::uvec3 corners : soup.triangles) {
        const glm::vec3 at = soup.positions[corners.x];
        addTriangle(scene, at, at + glm::vec3(0.0005f, 0, 0), at + glm::vec3(0, 0.0005f, 0.0003f));
    }
    return scene;
}

TEST(MetaTableBudget, makesTheAutomaticLatticeCoarser) {
    const Scene scene = motes(20000);
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    EXPECT_LE(structure.table.words.size() * sizeof(std::uint32_t), kAutomaticTableBudget);
    EXPECT_LT(structure.lattice.resolution.x, kMaxLatticeResolution);
    EXPECT_FALSE(structure.options.cells);
    AccelerationOptions wanted;
    wanted.cells = 1000000000;
    EXPECT_GT(buildAccelerationStructure(motes(300), wanted).lattice.cellCount, 900000000u);
}

} // namespace
} // namespace metamarch::tests
