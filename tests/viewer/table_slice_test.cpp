// SPDX-License-Identifier: MIT
#include "metamarch/viewer/table_slice.h"

#include <gtest/gtest.h>

namespace metamarch::viewer {
namespace {

// 12 x 8 x 8 cells: leaf 0 up to x = 4, leaf 1 behind it, but leaf 2 above y = 6 there.
MetaTable threeLeaves() {
    std::vector<Leaf> leaves(3);
    const ivec3 boxes[3][2] = {{{0, 0, 0}, {4, 8, 8}}, {{4, 0, 0}, {12, 6, 8}}, {{4, 6, 0}, {12, 8, 8}}};
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        leaves[i].lo = packCell(boxes[i][0]);
        leaves[i].hi = packCell(boxes[i][1]);
    }
    return buildMetaTable({12, 8, 8}, leaves);
}

TEST(TableSlice, hasTheLeavesOfTheBrickAroundTheCell) {
    const MetaTable table = threeLeaves();
    const TableSlice slice = tableSlice(table, {5, 3, 2}, {1.0f, -0.5f, 0.1f});
    EXPECT_EQ(slice.axes, (std::array{0, 1}));
    EXPECT_EQ(slice.first, ivec3(0, 0, 2));
    EXPECT_FALSE(slice.isOneWord);
    for (std::size_t up = 0; up < 8; ++up) {
        for (std::size_t right = 0; right < 8; ++right) {
            EXPECT_EQ(slice.leaves[up][right], right < 4 ? 0u : up < 6 ? 1u : 2u);
        }
    }
}

TEST(TableSlice, liesAlongTheRayAndEndsWithTheLattice) {
    const MetaTable table = threeLeaves();
    EXPECT_EQ(tableSlice(table, {5, 3, 2}, {0.1f, 1.0f, 1.0f}).axes, (std::array{2, 1}));
    EXPECT_EQ(tableSlice(table, {5, 3, 2}, {-1.0f, 0.0f, 1.0f}).axes, (std::array{0, 2}));
    const TableSlice last = tableSlice(table, {9, 3, 2}, {1.0f, 0.5f, 0.1f});
    EXPECT_EQ(last.brick, ivec3(1, 0, 0));
    EXPECT_EQ(last.leaves[3][3], 1u);
    EXPECT_EQ(last.leaves[3][4], TableSlice::kOutside);
    EXPECT_EQ(last.first.z, 2);
}

TEST(TableSlice, saysWhereOneWordIsEnough) {
    std::vector<Leaf> leaves(1);
    leaves[0].lo = packCell(ivec3(0, 0, 0));
    leaves[0].hi = packCell(ivec3(16, 8, 8));
    EXPECT_TRUE(tableSlice(buildMetaTable({16, 8, 8}, leaves), {3, 3, 3}, {1, 0, 0}).isOneWord);
}

} // namespace
} // namespace metamarch::viewer
