// SPDX-License-Identifier: MIT
// The cells in which a triangle is listed, against a test of every single cell.
#include "accel/overlap.h"
#include "metamarch/accel/triangle_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

namespace metamarch::tests {
namespace {

// Returns the range of the cells in `box` that meet the triangle if grown by `margin`.
std::optional<CellRange> bruteForceCells(const LatticeTriangle& triangle, const CellRange& box,
                                         const glm::dvec3& margin) {
    std::optional<CellRange> range;
    CellCorner cell;
    for (cell[2] = box.lo[2]; cell[2] <= box.hi[2]; ++cell[2]) {
        for (cell[1] = box.lo[1]; cell[1] <= box.hi[1]; ++cell[1]) {
            for (cell[0] = box.lo[0]; cell[0] <= box.hi[0]; ++cell[0]) {
                if (!overlaps(triangle, grown({cell, cell}, margin))) {
                    continue;
                }
                if (!range) {
                    range = CellRange{cell, cell};
                }
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    range->lo[axis] = std::min(range->lo[axis], cell[axis]);
                    range->hi[axis] = std::max(range->hi[axis], cell[axis]);
                }
            }
        }
    }
    return range;
}

bool contains(const CellRange& outer, const CellRange& inner) {
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        inside = inside && outer.lo[axis] <= inner.lo[axis] && inner.hi[axis] <= outer.hi[axis];
    }
    return inside;
}

std::string describe(const std::optional<CellRange>& range) {
    if (!range) {
        return "none";
    }
    const auto& [lo, hi] = *range;
    return (testing::Message() << lo[0] << " " << lo[1] << " " << lo[2] << " to " << hi[0] << " " << hi[1]
                               << " " << hi[2])
        .GetString();
}

// Boxes as large as inner nodes, up to 1023 cells from the origin, in lattices of this resolution, with which
// the margin in cells grows.
struct ClipCase {
    const char* name;
    CellRange box;
    glm::dvec3 resolution;
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const ClipCase& clipCase, std::ostream* out) { *out << clipCase.name; }

const ClipCase kCases[] = {
    {"one_cell", {{0, 0, 0}, {0, 0, 0}}, glm::dvec3(1.0)},
    {"corner_cell", {{1022, 1022, 1022}, {1022, 1022, 1022}}, glm::dvec3(1023.0)},
    {"small", {{3, 5, 2}, {5, 6, 5}}, {12.0, 9.0, 7.0}},
    {"slab", {{0, 4, 0}, {11, 4, 6}}, {12.0, 9.0, 7.0}},
    {"needle", {{1000, 0, 511}, {1022, 0, 511}}, {1023.0, 1.0, 1023.0}},
    {"far_corner", {{1017, 1015, 1018}, {1022, 1022, 1022}}, glm::dvec3(1023.0)},
};

constexpr unsigned kTriangleKinds = 8;

// Makes triangles of one kind after the other, in and around the box.
class TriangleMaker {
  public:
    TriangleMaker(const CellRange& box, const glm::dvec3& usedMargin)
        : lo(box.lo[0], box.lo[1], box.lo[2]), hi(box.hi[0] + 1.0, box.hi[1] + 1.0, box.hi[2] + 1.0),
          margin(usedMargin) {}

    LatticeTriangle make(const unsigned kind) {
        const int axis = static_cast<int>(random() % 3);
        LatticeTriangle triangle = {point(1.0), point(1.0), point(1.0)};
        switch (kind) {
        case 0: // about as large as the box
            return triangle;
        case 1: // far larger than the box
            return {point(100.0), point(100.0), point(100.0)};
        case 2: // about as large as a cell
            return {triangle[0], triangle[0] + 2.0 * unit() - 1.0, triangle[0] + 2.0 * unit() - 1.0};
        case 3: // a sliver
            triangle[2] = glm::mix(triangle[0], triangle[1], unit().x) + 1e-9 * unit();
            return triangle;
        case 4: // in a lattice plane
            triangle[0][axis] = triangle[1][axis] = triangle[2][axis] = std::round(triangle[0][axis]);
            return triangle;
        case 5: // all corners are lattice points
            return {glm::round(point(2.0)), glm::round(point(2.0)), glm::round(point(2.0))};
        case 6: // one to three margins away from a lattice plane
            triangle[0][axis] = triangle[1][axis] = triangle[2][axis] =
                std::round(triangle[0][axis]) + margin[axis] * (6.0 * unit().x - 3.0);
            return triangle;
        default: // a segment or a point
            triangle[2] = triangle[1];
            return random() % 2 == 0 ? triangle : LatticeTriangle{triangle[0], triangle[0], triangle[0]};
        }
    }

  private:
    glm::dvec3 unit() {
        std::uniform_real_distribution<double> distribution(0.0, 1.0);
        return {distribution(random), distribution(random), distribution(random)};
    }

    // Returns a point in the box or around it, within `reach` times its size plus a cell.
    glm::dvec3 point(const double reach) {
        const glm::dvec3 size = hi - lo + 1.0;
        return lo - 0.5 - 0.5 * (reach - 1.0) * size + unit() * (reach * size);
    }

    glm::dvec3 lo;
    glm::dvec3 hi;
    glm::dvec3 margin;
    std::mt19937 random{17};
};

class TouchedCells : public testing::TestWithParam<ClipCase> {};

TEST_P(TouchedCells, areThoseThatBruteForceFinds) {
    const CellRange& box = GetParam().box;
    const glm::dvec3 margin = 0x1p-18 * GetParam().resolution;
    TriangleMaker maker(box, margin);
    std::array<unsigned, kTriangleKinds> inside{};
    std::array<unsigned, kTriangleKinds> outside{};
    for (unsigned i = 0; i < 6000; ++i) {
        const unsigned kind = i % kTriangleKinds;
        const LatticeTriangle triangle = maker.make(kind);
        const auto cells = touchedCells(triangle, box, margin);
        const auto least = bruteForceCells(triangle, box, margin * (1.0 - kMarginRounding));
        const auto most = bruteForceCells(triangle, box, margin * (1.0 + kMarginRounding));
        EXPECT_TRUE(!least || (cells && contains(*cells, *least)))
            << "triangle " << i << " of kind " << kind << ": " << describe(cells) << " lacks some of "
            << describe(least);
        EXPECT_TRUE(!cells || (most && contains(*most, *cells)))
            << "triangle " << i << " of kind " << kind << ": " << describe(cells) << " is more than "
            << describe(most);
        ++(cells ? inside : outside)[kind];
    }
    for (unsigned kind = 0; kind < kTriangleKinds; ++kind) {
        EXPECT_GT(inside[kind], 0u) << "triangles of kind " << kind;
        EXPECT_GT(outside[kind], 0u) << "triangles of kind " << kind;
    }
}

INSTANTIATE_TEST_SUITE_P(Boxes, TouchedCells, testing::ValuesIn(kCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

// Two boxes share a plane: no triangle may be missed by both.
TEST(TouchedCellsAtAPlane, areInAtLeastOneOfTheHalves) {
    const CellRange below{{0, 0, 0}, {4, 9, 9}};
    const CellRange above{{5, 0, 0}, {9, 9, 9}};
    const glm::dvec3 margin(10.0 * 0x1p-18);
    for (const double offset : {0.0, 0x1p-60, -0x1p-60, 0x1p-50, -0x1p-50, 0x1p-20, -0x1p-20}) {
        const double x = 5.0 + offset;
        const LatticeTriangle triangle = {glm::dvec3(x, 1.0, 1.0), {x, 2.0, 1.0}, {x, 1.0, 2.0}};
        EXPECT_TRUE(touchedCells(triangle, below, margin));
        EXPECT_TRUE(touchedCells(triangle, above, margin));
    }
}

} // namespace
} // namespace metamarch::tests
