// Every cell names the leaf that holds it.
#include "accel/acceleration_structure.h"
#include "accel/meta_table.h"
#include "fixtures/shapes.h"

#include <gtest/gtest.h>

namespace metamarch::tests {
namespace {

void expectCellsInTheirLeaves(const Lattice& lattice, const std::span<const std::uint32_t> leafOfCell,
                              const std::span<const Leaf> leaves) {
    ASSERT_EQ(leafOfCell.size(), lattice.cellCount);
    const glm::ivec3 resolution(lattice.resolution);
    glm::ivec3 cell;
    for (cell.z = 0; cell.z < resolution.z; ++cell.z) {
        for (cell.y = 0; cell.y < resolution.y; ++cell.y) {
            for (cell.x = 0; cell.x < resolution.x; ++cell.x) {
                const std::uint32_t leafId = leafOfCell[cellIndex(cell, lattice.resolution)];
                ASSERT_LT(leafId, leaves.size());
                ASSERT_TRUE(glm::all(glm::lessThanEqual(unpackCell(leaves[leafId].lo), cell)));
                ASSERT_TRUE(glm::all(glm::lessThan(cell, unpackCell(leaves[leafId].hi))));
            }
        }
    }
}

Lattice latticeOf(const glm::uvec3 resolution) {
    Lattice lattice{};
    lattice.resolution = resolution;
    lattice.cellCount = resolution.x * resolution.y * resolution.z;
    return lattice;
}

Leaf leafOver(const glm::uvec3 lo, const glm::uvec3 hi) { return {packCell(lo), packCell(hi), 0, 0}; }

// The paper's figure 11: a partition that no kd-tree can express.
TEST(MetaTable, takesAPinwheel) {
    const Lattice lattice = latticeOf({3, 3, 2});
    const std::vector<Leaf> leaves = {
        leafOver({0, 0, 0}, {2, 1, 2}), leafOver({2, 0, 0}, {3, 2, 2}), leafOver({1, 2, 0}, {3, 3, 2}),
        leafOver({0, 1, 0}, {1, 3, 2}), leafOver({1, 1, 0}, {2, 2, 2}),
    };
    const std::vector<std::uint32_t> layer = {0, 0, 1, 3, 4, 1, 3, 2, 2};
    std::vector<std::uint32_t> expected = layer;
    expected.insert(expected.end(), layer.begin(), layer.end());
    EXPECT_EQ(buildMetaTable(lattice.resolution, leaves).leafOfCell, expected);
}

TEST(MetaTable, reachesTheLastCellOfTheFinestLattice) {
    const Lattice lattice = latticeOf({1023, 2, 3});
    const std::vector<Leaf> leaves = {leafOver({0, 0, 0}, {1022, 2, 3}),
                                      leafOver({1022, 0, 0}, {1023, 2, 3})};
    expectCellsInTheirLeaves(lattice, buildMetaTable(lattice.resolution, leaves).leafOfCell, leaves);
}

TEST(MetaTable, namesTheLeavesOfTheTree) {
    for (const AccelerationOptions& options :
         {AccelerationOptions{}, AccelerationOptions{glm::dvec3(0.01, 0.3, 0.05), {}, {}},
          AccelerationOptions{{}, {}, 0u}}) {
        const AccelerationStructure structure = buildAccelerationStructure(triangleSoup(2000, 6), options);
        expectCellsInTheirLeaves(structure.lattice, structure.table.leafOfCell, structure.tree.leaves);
        expectCellsInTheirLeaves(structure.lattice, structure.table.leafOfCell, structure.table.leaves);
    }
}

} // namespace
} // namespace metamarch::tests
