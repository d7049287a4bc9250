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

TEST(EnvironmentTables, drawTheWholeSphereAlikeWhereTheLightIs) {
    const Environment map = flat(6, 5, 2.5f);
    const EnvironmentTables tables = makeEnvironmentTables(map);
    ASSERT_EQ(tables.rows.size(), 5u);
    ASSERT_EQ(tables.columns.size(), 30u);
    for (std::size_t y = 0; y < 5; ++y) {
        const double top = M_PI * static_cast<double>(y) / 5.0;
        EXPECT_NEAR(tables.rows[y].probability, (std::cos(top) - std::cos(top + M_PI / 5.0)) / 2.0, 1e-7);
        for (std::size_t x = 0; x < 6; ++x) {
            EXPECT_FLOAT_EQ(tables.columns[y * 6 + x].probability, 1.0f / 6.0f);
        }
    }
}

// The bilinear tent of a texel reaches all eight neighbours, across the seam too.
TEST(EnvironmentTables, spreadATexelOverItsNeighbours) {
    Environment map = flat(8, 8, 0.0f);
    map.texels[3 * 8 + 0] = glm::vec3(1.0f);
    const EnvironmentTables tables = makeEnvironmentTables(map);
    for (std::size_t y = 0; y < 8; ++y) {
        EXPECT_EQ(tables.rows[y].probability > 0.0f, y >= 2 && y <= 4) << y;
    }
    const auto column = [&](std::size_t y, std::size_t x) { return tables.columns[y * 8 + x].probability; };
    for (std::size_t y = 2; y <= 4; ++y) {
        EXPECT_FLOAT_EQ(column(y, 0), 0.75f);
        EXPECT_FLOAT_EQ(column(y, 1), 0.125f);
        EXPECT_FLOAT_EQ(column(y, 7), 0.125f);
    }
}

TEST(EnvironmentTables, takeMapsOfOneTexelAndOfNoLight) {
    for (const float radiance : {0.0f, 1.0f, 1e30f}) {
        const EnvironmentTables tables = makeEnvironmentTables(flat(1, 1, radiance));
        ASSERT_EQ(tables.rows.size(), 1u);
        ASSERT_EQ(tables.columns.size(), 1u);
        EXPECT_EQ(tables.rows[0].probability, 1.0f);
        EXPECT_EQ(tables.columns[0].probability, 1.0f);
    }
    const EnvironmentTables dark = makeEnvironmentTables(flat(4, 2, 0.0f));
    EXPECT_EQ(dark.rows[0].probability, 0.5f);
    EXPECT_EQ(dark.columns[5].probability, 0.25f);
}

// If the luminance of 1e38 or the sum of a row overflowed, nothing could be drawn.
TEST(EnvironmentTables, takeTheBrightestLightThereIs) {
    const EnvironmentTables tables = makeEnvironmentTables(flat(512, 4, 3e38f));
    double all = 0.0;
    for (const TableEntry& row : tables.rows) {
        ASSERT_TRUE(std::isfinite(row.probability));
        all += row.probability;
    }
    EXPECT_NEAR(all, 1.0, 1e-6);
    EXPECT_FLOAT_EQ(tables.columns[700].probability, 1.0f / 512.0f);
}

} // namespace
} // namespace metamarch
