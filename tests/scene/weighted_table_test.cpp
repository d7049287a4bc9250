// SPDX-License-Identifier: MIT
// Weighted tables for lists of lights and for environments.
#include "metamarch/shading/light/weighted_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace metamarch {
namespace {

// Returns the entry that the table draws for u, searched from its guide.
std::size_t drawnBy(std::span<const TableEntry> table, float u) {
    std::size_t index = table[guideSlot(u, static_cast<uint>(table.size()))].guide;
    while (table[index].upTo <= u) {
        ++index;
    }
    return index;
}

// The ends of entries are rounded to floats, by 2^-25 each.
void expectDrawnBy(const std::vector<float>& weights) {
    const std::vector<TableEntry> table = makeWeightedTable(weights);
    ASSERT_EQ(table.size(), weights.size());
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    double all = 0.0;
    EXPECT_EQ(table[0].from, 0.0f);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double expected = weights[i] / sum;
        ASSERT_FLOAT_EQ(table[i].probability, static_cast<float>(expected)) << i;
        ASSERT_NEAR(static_cast<double>(table[i].upTo) - table[i].from, expected, 6e-8) << i;
        if (weights[i] == 0.0f) {
            ASSERT_EQ(table[i].from, table[i].upTo) << i;
        }
        all += table[i].probability;
    }
    EXPECT_NEAR(all, 1.0, 1e-6);
    std::mt19937 random(13);
    for (int i = 0; i < 2000; ++i) {
        // Includes the numbers at the borders of guide slots and entries.
        const std::size_t any = random() % weights.size();
        const float slot = static_cast<float>(any) / static_cast<float>(weights.size());
        const float even = static_cast<float>(random() >> 8u) * 0x1p-24f;
        for (const float u : {even, slot, std::nextafter(slot, 0.0f), table[any].from}) {
            if (u < 1.0f) {
                const TableEntry& entry = table[drawnBy(table, u)];
                ASSERT_TRUE(entry.from <= u && u < entry.upTo) << u;
                ASSERT_GT(entry.probability, 0.0f);
            }
        }
    }
}

TEST(WeightedTable, drawsByWeight) {
    expectDrawnBy({1.0f, 2.0f, 3.0f});
    expectDrawnBy({5.0f, 5.0f, 5.0f, 5.0f});
    expectDrawnBy({1e-30f, 1e-20f, 1e30f});
    std::mt19937 random(11);
    std::uniform_real_distribution<float> even;
    for (const std::size_t count : {2u, 3u, 17u, 1024u, 8192u}) {
        std::vector<float> weights(count);
        for (float& weight : weights) {
            weight = even(random);
        }
        expectDrawnBy(weights);
        for (float& weight : weights) {
            weight = std::exp(20.0f * even(random)); // over nine orders of magnitude
        }
        expectDrawnBy(weights);
    }
}

TEST(WeightedTable, neverDrawsAWeightOfZero) {
    expectDrawnBy({0.0f, 1.0f});
    expectDrawnBy({0.0f, 0.0f, 0.0f, 7.0f, 0.0f});
    std::mt19937 random(12);
    std::uniform_real_distribution<float> even;
    for (int round = 0; round < 200; ++round) {
        std::vector<float> weights(300);
        for (float& weight : weights) {
            weight = even(random) < 0.3f ? 0.0f : even(random);
        }
        expectDrawnBy(weights);
    }
}

TEST(WeightedTable, ofOneEntryDrawsIt) {
    for (const float weight : {0.0f, 1e-38f, 3.0f}) {
        const std::vector<TableEntry> table = makeWeightedTable(std::vector<float>{weight});
        ASSERT_EQ(table.size(), 1u);
        EXPECT_EQ(table[0].upTo, 1.0f);
        EXPECT_EQ(table[0].guide, 0u);
        EXPECT_EQ(table[0].probability, 1.0f);
    }
}

TEST(WeightedTable, ofZerosDrawsAllAlike) {
    for (const TableEntry& entry : makeWeightedTable(std::vector<float>(8, 0.0f))) {
        EXPECT_EQ(entry.upTo - entry.from, 0.125f);
        EXPECT_EQ(entry.probability, 0.125f);
    }
}

TEST(WeightedTable, ofNothingIsEmpty) { EXPECT_TRUE(makeWeightedTable({}).empty()); }

Environment flat(std::uint32_t width, std::uint32_t height, float radiance) {
    Environment map;
    map.width = width;
    map.height = height;
    map.texels.assign(std::size_t{width} * height, glm::vec3(radiance));
    return map;
}

// Returns the probability of each cell without the surface's normal: the mean of its corners' weights.
float cellWeight(const Environment& map, const EnvironmentTables& tables, std::uint32_t row,
                 std::uint32_t x) {
    const auto at = [&](std::uint32_t column, std::uint32_t y) {
        return tables.weights[std::size_t{y} * map.width + column % map.width];
    };
    const std::uint32_t upper = std::max(row, 1u) - 1;
    const std::uint32_t lower = std::min(row, map.height - 1);
    const float part = row == 0 || row == map.height ? 0.5f : 1.0f;
    return 0.25f * part * (at(x, upper) + at(x + 1, upper) + at(x, lower) + at(x + 1, lower));
}

// The three tables together draw each cell by its weight.
TEST(EnvironmentTables, drawCellsByTheirWeights) {
    Environment map = flat(50, 21, 0.5f);
    for (std::size_t i = 0; i < map.texels.size(); i += 7) {
        map.texels[i] = glm::vec3(static_cast<float>(i % 13));
    }
    const EnvironmentTables tables = makeEnvironmentTables(map);
    const std::span any(&tables.blocks[std::size_t{kAnyNormal} * kMapBlocks], kMapBlocks);
    double whole = 0.0;
    for (std::uint32_t row = 0; row <= map.height; ++row) {
        for (std::uint32_t x = 0; x < map.width; ++x) {
            const std::uint32_t across = x >> tables.blockColumnShift;
            const TableEntry& block = any[(row >> tables.blockRowShift) * kBlocksAcross + across];
            const double drawn = static_cast<double>(block.upTo - block.from) *
                                 tables.rows[across * (map.height + 1) + row].probability *
                                 tables.columns[row * map.width + x].probability;
            EXPECT_NEAR(drawn * 50 * 21, cellWeight(map, tables, row, x), 1e-4) << row << " " << x;
            EXPECT_NEAR(block.probability, block.upTo > block.from ? 1.0f : 0.0f, 1e-5f);
            whole += drawn;
        }
    }
    EXPECT_NEAR(whole, 1.0, 1e-5);
    EXPECT_NEAR(std::accumulate(tables.weights.begin(), tables.weights.end(), 0.0) / (50 * 21), 1.0, 1e-6);
}

// Away from the poles, the cells of a uniform map are drawn by their solid angles.
TEST(EnvironmentTables, drawTheWholeSphereAlikeWhereTheLightIs) {
    const Environment map = flat(6, 50, 2.5f);
    const EnvironmentTables tables = makeEnvironmentTables(map);
    for (std::uint32_t row = 1; row < 50; ++row) {
        const double top = M_PI * (row - 0.5) / 50.0;
        const double expected = 0.5 * (std::cos(top) - std::cos(top + M_PI / 50.0)) / 6.0;
        EXPECT_NEAR(cellWeight(map, tables, row, 2) / 300.0, expected, 0.001 * expected) << row;
    }
}

// The bilinear tent of a texel reaches the four cells around it, across the seam too.
TEST(EnvironmentTables, spreadATexelOverItsCells) {
    Environment map = flat(8, 8, 0.0f);
    map.texels[24] = glm::vec3(1.0f); // the first of row 3
    const EnvironmentTables tables = makeEnvironmentTables(map);
    EXPECT_EQ(tables.weights[24], 64.0f);
    for (std::uint32_t row = 0; row < 9; ++row) {
        for (std::uint32_t x = 0; x < 8; ++x) {
            const bool isBeside = (row == 3 || row == 4) && (x == 0 || x == 7);
            EXPECT_EQ(cellWeight(map, tables, row, x), isBeside ? 16.0f : 0.0f);
        }
    }
}

// A normal draws blocks by the cosine; those below its horizon not at all.
TEST(EnvironmentTables, knowTheCosine) {
    const EnvironmentTables tables = makeEnvironmentTables(flat(64, 32, 1.0f));
    const std::span up(&tables.blocks[std::size_t{normalBin(vec3(0, 1, 0))} * kMapBlocks], kMapBlocks);
    const auto chance = [&](std::size_t row) {
        return up[row * kBlocksAcross].upTo - up[row * kBlocksAcross].from;
    };
    EXPECT_GT(chance(3), 0.0f);
    EXPECT_EQ(chance(6), 0.0f);
    EXPECT_GT(up[kBlocksAcross].probability, 2.0f * up[std::size_t{3} * kBlocksAcross].probability);
    EXPECT_EQ(up[std::size_t{6} * kBlocksAcross].probability, 0.0f);
}

TEST(EnvironmentTables, takeMapsOfOneTexelAndOfNoLight) {
    for (const float radiance : {0.0f, 1.0f, 1e30f}) {
        const EnvironmentTables tables = makeEnvironmentTables(flat(1, 1, radiance));
        EXPECT_EQ(tables.weights, std::vector<float>{radiance > 0.0f ? 1.0f : 0.0f});
        EXPECT_EQ(tables.columns.size(), 2u);
        EXPECT_EQ(tables.columns[0].probability, 1.0f);
    }
    const EnvironmentTables dark = makeEnvironmentTables(flat(4, 2, 0.0f));
    EXPECT_EQ(dark.weights[3], 0.0f);
    EXPECT_EQ(dark.columns[5].probability, 1.0f);
    for (const TableEntry& entry : dark.blocks) {
        EXPECT_EQ(entry.probability, 0.0f);
    }
}

// If the luminance of 1e38 or the sum of a row overflowed, nothing could be drawn.
TEST(EnvironmentTables, takeTheBrightestLightThereIs) {
    const EnvironmentTables tables = makeEnvironmentTables(flat(512, 4, 3e38f));
    for (const TableEntry& block : tables.blocks) {
        ASSERT_TRUE(std::isfinite(block.probability));
    }
    EXPECT_FLOAT_EQ(tables.columns[700].probability, 1.0f / 32.0f);
}

} // namespace
} // namespace metamarch
