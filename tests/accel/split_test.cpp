// SPDX-License-Identifier: MIT
// The builder's choice of a split, against the cost of every plane found by counting.
#include "metamarch/accel/split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <random>
#include <vector>

namespace metamarch::tests {
namespace {

double surface(const glm::dvec3 size) { return 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x); }

// The cost of a split's children by definition: a ray crosses each with a probability proportional to its
// surface.
double costOf(const std::span<const TriangleReference> references, const CellRange& box,
              const glm::dvec3& cellSize, const unsigned axis, const unsigned plane) {
    const auto countIf = [&](const auto& predicate) {
        return static_cast<std::size_t>(std::count_if(references.begin(), references.end(), predicate));
    };
    const std::size_t below =
        countIf([&](const TriangleReference& reference) { return reference.cells.lo[axis] < plane; });
    const std::size_t above =
        countIf([&](const TriangleReference& reference) { return reference.cells.hi[axis] >= plane; });
    const glm::dvec3 lo(box.lo[0], box.lo[1], box.lo[2]);
    const glm::dvec3 hi(box.hi[0] + 1, box.hi[1] + 1, box.hi[2] + 1);
    glm::dvec3 middleLo = lo;
    glm::dvec3 middleHi = hi;
    middleLo[static_cast<int>(axis)] = middleHi[static_cast<int>(axis)] = plane;
    const double cost = (surface((middleHi - lo) * cellSize) * leafCost(below) +
                         surface((hi - middleLo) * cellSize) * leafCost(above)) /
                        surface((hi - lo) * cellSize);
    return below == 0 || above == 0 ? (1.0 - kEmptyBonus) * cost : cost;
}

std::vector<TriangleReference> randomReferences(const CellRange& box, const std::size_t count,
                                                const std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<TriangleReference> references(count);
    for (std::size_t i = 0; i < count; ++i) {
        references[i].triangleId = static_cast<std::uint32_t>(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::uniform_int_distribution<unsigned> cell(box.lo[axis], box.hi[axis]);
            const auto [first, last] = std::minmax({cell(random), cell(random), cell(random)});
            // Many small references and a few large ones.
            references[i].cells.lo[axis] = static_cast<std::uint16_t>(first);
            references[i].cells.hi[axis] = static_cast<std::uint16_t>(i % 8 == 0 ? last : first);
        }
    }
    return references;
}

struct SplitCase {
    const char* name;
    CellRange box;
    glm::dvec3 cellSize;
    std::size_t references;
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const SplitCase& splitCase, std::ostream* out) { *out << splitCase.name; }

const SplitCase kCases[] = {
    {"cube", {{0, 0, 0}, {9, 9, 9}}, glm::dvec3(1.0), 100},
    {"far_corner", {{1000, 1010, 1015}, {1022, 1022, 1022}}, glm::dvec3(0.002), 100},
    {"slab", {{5, 3, 0}, {5, 40, 40}}, {0.01, 0.3, 0.9}, 50},
    {"needle", {{7, 0, 7}, {7, 1022, 7}}, glm::dvec3(1e-6), 30},
    {"two_cells", {{0, 0, 4}, {0, 0, 5}}, glm::dvec3(1.0), 3},
    {"one_reference", {{0, 0, 0}, {20, 20, 20}}, {3.0, 2.0, 1.0}, 1},
    {"swept_in_parallel", {{2, 3, 4}, {40, 50, 30}}, {1.0, 2.0, 3.0}, 20000},
};

class FindSplit : public testing::TestWithParam<SplitCase> {};

TEST_P(FindSplit, findsTheCheapestPlane) {
    const auto& [name, box, cellSize, count] = GetParam();
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
        const std::vector<TriangleReference> references = randomReferences(box, count, seed);
        const auto split = findSplit(references, box, cellSize);
        ASSERT_TRUE(split);
        ASSERT_LT(split->axis, 3u);
        EXPECT_GT(split->plane, box.lo[split->axis]);
        EXPECT_LE(split->plane, box.hi[split->axis]);
        const double cost = costOf(references, box, cellSize, split->axis, split->plane);
        constexpr double kRounding = 1e-12;
        EXPECT_NEAR(split->cost, cost, kRounding * cost);
        for (unsigned axis = 0; axis < 3; ++axis) {
            for (unsigned plane = box.lo[axis] + 1u; plane <= box.hi[axis]; ++plane) {
                EXPECT_GE(costOf(references, box, cellSize, axis, plane), (1.0 - kRounding) * cost)
                    << "axis " << axis << ", plane " << plane;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Nodes, FindSplit, testing::ValuesIn(kCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(FindSplitTie, goesToTheLowestAxisAndPlane) {
    // All references fill the cube, so all its planes cost the same, to the bit.
    const CellRange cube{{4, 4, 4}, {7, 7, 7}};
    const std::vector<TriangleReference> references(5, TriangleReference{0, cube});
    const auto split = findSplit(references, cube, glm::dvec3(1.0));
    ASSERT_TRUE(split);
    EXPECT_EQ(split->axis, 0u);
    EXPECT_EQ(split->plane, 5u);

    const CellRange flat{{4, 4, 4}, {4, 7, 7}};
    const std::vector<TriangleReference> flatReferences(5, TriangleReference{0, flat});
    const auto flatSplit = findSplit(flatReferences, flat, glm::dvec3(1.0));
    ASSERT_TRUE(flatSplit);
    EXPECT_EQ(flatSplit->axis, 1u);
    EXPECT_EQ(flatSplit->plane, 5u);
}

TEST(FindSplitBonus, favoursCuttingOffEmptySpace) {
    // Without the bonus, the plane at 5 would cost less than the plane at 1, below which there are no
    // triangles.
    const CellRange box{{0, 0, 0}, {9, 0, 0}};
    std::vector<TriangleReference> references(6, TriangleReference{0, {{1, 0, 0}, {9, 0, 0}}});
    references.insert(references.end(), 2, TriangleReference{0, {{1, 0, 0}, {4, 0, 0}}});
    references.insert(references.end(), 2, TriangleReference{0, {{5, 0, 0}, {9, 0, 0}}});
    ASSERT_LT(costOf(references, box, glm::dvec3(1.0), 0, 5),
              costOf(references, box, glm::dvec3(1.0), 0, 1) / (1.0 - kEmptyBonus));
    const auto split = findSplit(references, box, glm::dvec3(1.0));
    ASSERT_TRUE(split);
    EXPECT_EQ(split->plane, 1u);
}

TEST(FindSplitRefusal, oneCellHasNoPlane) {
    const CellRange cell{{3, 1022, 0}, {3, 1022, 0}};
    const std::vector<TriangleReference> references(100, TriangleReference{0, cell});
    EXPECT_FALSE(findSplit(references, cell, glm::dvec3(1.0)));
}

} // namespace
} // namespace metamarch::tests
