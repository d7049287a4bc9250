// SPDX-License-Identifier: MIT
// A lattice of uneven cells: its planes, and the search for the cell of a position.
#include "metamarch/accel/rectilinear_planes.h"
#include "metamarch/accel/triangle_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace metamarch::tests {
namespace {

using Inner = std::array<std::vector<float>, 3>;

struct NamedPlanes {
    const char* name;
    std::vector<float> inner;
    float extent;
};

std::vector<float> evenPlanes(const int cells) {
    std::vector<float> planes;
    for (int i = 1; i < cells; ++i) {
        planes.push_back(static_cast<float>(i));
    }
    return planes;
}

std::vector<float> randomPlanes(const int count, const float extent) {
    std::mt19937 random(5);
    std::vector<float> planes(static_cast<std::size_t>(count));
    std::ranges::generate(planes, [&] { return extent * std::generate_canonical<float, 24>(random); });
    return planes;
}

// Returns the maximum number of planes, each the next float after the one before: a single bucket holds them
// all.
std::vector<float> adjacentPlanes(const float first) {
    std::vector<float> planes{first};
    while (planes.size() < kMaxLatticeResolution - 1) {
        planes.push_back(std::nextafter(planes.back(), kFarthest));
    }
    return planes;
}

std::vector<float> halvedPlanes(const float extent) {
    std::vector<float> planes;
    for (int i = 1; i < 140; ++i) {
        planes.push_back(std::ldexp(extent, -i)); // down to denormals
    }
    return planes;
}

const NamedPlanes kPlanes[] = {
    {"none", {}, 1.0f},
    {"one", {0.3f}, 1.0f},
    {"even", evenPlanes(200), 200.0f},
    {"random", randomPlanes(700, 37.5f), 37.5f},
    {"adjacent_at_the_end", adjacentPlanes(0.999f), 1.0f},
    {"adjacent_at_the_start", adjacentPlanes(1e-30f), 1023.0f},
    {"halved", halvedPlanes(64.0f), 64.0f},
    {"at_the_faces", {std::nextafter(0.0f, 1.0f), std::nextafter(5.0f, 0.0f)}, 5.0f},
};

class RectilinearPlanesTest : public testing::TestWithParam<NamedPlanes> {
  protected:
    RectilinearPlanes across(const int axis) const {
        Inner inner;
        inner[static_cast<std::size_t>(axis)] = GetParam().inner;
        return {inner, vec3(GetParam().extent)};
    }
};

// Returns the cell of a coordinate by a binary search over the inner planes.
int cellOf(std::vector<float> inner, const float coordinate) {
    std::ranges::sort(inner);
    const auto repeated = std::ranges::unique(inner);
    inner.erase(repeated.begin(), repeated.end());
    return static_cast<int>(std::ranges::upper_bound(inner, coordinate) - inner.begin());
}

TEST_P(RectilinearPlanesTest, positionsFindTheCellsThatABinarySearchFinds) {
    const float extent = GetParam().extent;
    std::vector<float> coordinates = randomPlanes(20000, extent);
    for (const float plane : GetParam().inner) {
        for (const float neighbour :
             {std::nextafter(plane, 0.0f), plane, std::nextafter(plane, extent), plane * 1.0001f}) {
            coordinates.push_back(std::min(neighbour, std::nextafter(extent, 0.0f)));
        }
    }
    coordinates.insert(coordinates.end(), {0.0f, -0.0f, std::nextafter(extent, 0.0f)});
    for (int axis = 0; axis < 3; ++axis) {
        const RectilinearPlanes planes = across(axis);
        for (const float coordinate : coordinates) {
            vec3 position(0.0f);
            position[axis] = coordinate;
            ivec3 expected(0);
            expected[axis] = cellOf(GetParam().inner, coordinate);
            ASSERT_EQ(planes.searchCell(position), expected) << coordinate << " on axis " << axis;
        }
    }
}

// The traversal clamps positions outside the lattice; the search only has to terminate for them.
TEST_P(RectilinearPlanesTest, positionsOutsideFindACellBeforeOrBehind) {
    const RectilinearPlanes planes = across(1);
    const int resolution = static_cast<int>(planes.layout().resolution.y);
    for (const float outside : {-std::numeric_limits<float>::denorm_min(), -1.0f, -kMaxCoordinate}) {
        EXPECT_EQ(planes.searchCell(vec3(outside)).y, 0);
    }
    for (const float outside : {GetParam().extent, 2.0f * GetParam().extent, kMaxCoordinate}) {
        EXPECT_EQ(planes.searchCell(vec3(outside)).y, resolution);
    }
}

TEST_P(RectilinearPlanesTest, everyPlaneHasItsNumber) {
    const RectilinearPlanes planes = across(2);
    for (const float plane : GetParam().inner) {
        const std::uint32_t number = planes.numberOf(2, plane);
        EXPECT_EQ(planes.plane(2, static_cast<int>(number)), plane);
        EXPECT_EQ(number, static_cast<std::uint32_t>(cellOf(GetParam().inner, plane)));
    }
}

INSTANTIATE_TEST_SUITE_P(Planes, RectilinearPlanesTest, testing::ValuesIn(kPlanes),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(RectilinearPlanes, areSortedOnceAndInside) {
    const RectilinearPlanes planes({{{3, 1, 1, 0, -1, 7, 5}, {}, {2.5f}}}, vec3(5, 1, 4));
    const std::vector<float> expected = {0, 1, 3, 5, kFarthest, 0, 1, kFarthest, 0, 2.5f, 4, kFarthest};
    EXPECT_EQ(planes.planes(), expected);
    EXPECT_EQ(planes.layout().resolution, glm::uvec3(3, 1, 2));
    EXPECT_EQ(planes.layout().firstPlane, glm::uvec3(0, 5, 8));
    EXPECT_EQ(planes.layout().cellCount, 6u);
    EXPECT_EQ(planes.numberOf(0, -1.0f), 0u);
    EXPECT_EQ(planes.numberOf(0, 5.0f), 3u);
    EXPECT_EQ(planes.numberOf(0, 7.0f), 3u);
}

// A search then looks at one or two planes.
TEST(RectilinearPlanes, aFineLookUpLeavesNoMoreThanOnePlaneToABucket) {
    const RectilinearPlanes planes({evenPlanes(1023), {0.5f, 0.6f, 1022.0f}, {}}, vec3(1023.0f));
    const Rectilinear& layout = planes.layout();
    for (int axis = 0; axis < 3; ++axis) {
        std::uint32_t before = 0;
        for (std::uint32_t bucket = 0; bucket <= layout.lastBucket[axis]; ++bucket) {
            const std::uint32_t cell = planes.buckets()[layout.firstBucket[axis] + bucket];
            EXPECT_LE(cell, before + 1) << "bucket " << bucket << " of axis " << axis;
            before = cell;
        }
    }
}

// If the planes are at the integers, the lattice is uniform.
TEST(RectilinearPlanes, trianglesTouchTheCellsOfAUniformLattice) {
    const glm::uvec3 resolution(9, 14, 5);
    const RectilinearPlanes planes({evenPlanes(9), evenPlanes(14), evenPlanes(5)}, vec3(resolution));
    std::mt19937 random(8);
    const auto unit = [&] { return std::generate_canonical<double, 53>(random); };
    for (int i = 0; i < 20000; ++i) {
        LatticeTriangle triangle;
        const glm::dvec3 around = glm::dvec3(unit(), unit(), unit()) * glm::dvec3(resolution);
        for (glm::dvec3& corner : triangle) {
            corner = around + 3.0 * glm::dvec3(unit() - 0.5, unit() - 0.5, unit() - 0.5);
            corner = i % 2 == 0 ? glm::round(corner) : corner; // on the planes
            corner = glm::clamp(corner, glm::dvec3(0.0), glm::dvec3(resolution));
        }
        CellRange box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const unsigned last = resolution[static_cast<int>(axis)] - 1;
            const auto a = static_cast<std::uint16_t>(std::lround(unit() * last));
            const auto b = static_cast<std::uint16_t>(std::lround(unit() * last));
            box.lo[axis] = std::min(a, b);
            box.hi[axis] = std::max(a, b);
        }
        for (const glm::dvec3 margin : {glm::dvec3(0.0), glm::dvec3(1e-4, 2e-4, 3e-4)}) {
            const auto expected = touchedCells(triangle, box, margin);
            const auto cells = planes.touchedCells(triangle, box, margin);
            ASSERT_EQ(cells.has_value(), expected.has_value());
            if (cells) {
                ASSERT_EQ(cells->lo, expected->lo);
                ASSERT_EQ(cells->hi, expected->hi);
            }
        }
    }
}

} // namespace
} // namespace metamarch::tests
