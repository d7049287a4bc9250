// SPDX-License-Identifier: MIT
// Polygons divided into triangles: the triangles must cover the polygon once.
#include "metamarch/scene/mesh/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

namespace metamarch {
namespace {

using Polygon = std::vector<glm::vec2>;
using Triangles = std::vector<glm::uvec3>;

// Twice the area; exact for small integers.
double doubleArea(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double doubleArea(const Polygon& polygon) {
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        sum += doubleArea(polygon[0], polygon[i], polygon[i + 1]);
    }
    return sum;
}

// The polygon in the plane z = 0 or in another coordinate plane.
std::vector<glm::vec3> inSpace(const Polygon& polygon, int axis = 2) {
    std::vector<glm::vec3> corners;
    for (const glm::vec2& point : polygon) {
        glm::vec3 corner(7.0f);
        corner[(axis + 1) % 3] = point.x;
        corner[(axis + 2) % 3] = point.y;
        corners.push_back(corner);
    }
    return corners;
}

Triangles triangulate(const std::vector<glm::vec3>& corners) {
    PolygonTriangulator triangulator;
    const std::span<const glm::uvec3> triangles = triangulator.triangulate(corners);
    return {triangles.begin(), triangles.end()};
}

// The sum of the triangles' areas, twice; each triangle turns like the polygon and has an area.
void expectCovered(const Polygon& polygon, const Triangles& triangles) {
    const double whole = doubleArea(polygon);
    double sum = 0.0;
    for (const glm::uvec3& triangle : triangles) {
        ASSERT_LT(std::max({triangle.x, triangle.y, triangle.z}), polygon.size());
        const double area = doubleArea(polygon[triangle.x], polygon[triangle.y], polygon[triangle.z]);
        EXPECT_GT(area * whole, 0.0);
        sum += area;
    }
    EXPECT_EQ(sum, whole) << testing::PrintToString(inSpace(polygon));
}

// Also: every side of a triangle is a side of the polygon or is shared with another triangle. As all
// triangles turn the same way, they then cover the polygon without gap or overlap.
void expectTriangulated(const Polygon& polygon, const Triangles& triangles) {
    expectCovered(polygon, triangles);
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const glm::uvec3& triangle : triangles) {
        for (int i = 0; i < 3; ++i) {
            ++sides[{triangle[i], triangle[(i + 1) % 3]}];
            --sides[{triangle[(i + 1) % 3], triangle[i]}];
        }
    }
    for (std::uint32_t i = 0; i < polygon.size(); ++i) {
        const std::uint32_t next = (i + 1) % static_cast<std::uint32_t>(polygon.size());
        --sides[{i, next}];
        ++sides[{next, i}];
    }
    EXPECT_TRUE(std::ranges::all_of(sides, [](const auto& side) { return side.second == 0; }));
}

void expectTriangulated(const Polygon& polygon) {
    expectTriangulated(polygon, triangulate(inSpace(polygon)));
    Polygon reversed(polygon.rbegin(), polygon.rend());
    expectTriangulated(reversed, triangulate(inSpace(reversed, 0)));
}

bool isOnSegment(const glm::vec2& a, const glm::vec2& b, const glm::vec2& point) {
    return orientation(a, b, point) == 0 && std::min(a.x, b.x) <= point.x && point.x <= std::max(a.x, b.x) &&
           std::min(a.y, b.y) <= point.y && point.y <= std::max(a.y, b.y);
}

bool meet(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c, const glm::vec2& d) {
    return isOnSegment(a, b, c) || isOnSegment(a, b, d) || isOnSegment(c, d, a) || isOnSegment(c, d, b) ||
           (orientation(a, b, c) * orientation(a, b, d) < 0 &&
            orientation(c, d, a) * orientation(c, d, b) < 0);
}

// Whether sides meet only at the corners between them.
bool isSimple(const Polygon& polygon) {
    const std::size_t count = polygon.size();
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec2& a = polygon[i];
        const glm::vec2& b = polygon[(i + 1) % count];
        if (isOnSegment(a, b, polygon[(i + 2) % count])) {
            return false;
        }
        for (std::size_t j = i + 2; j < count; ++j) {
            if ((j + 1) % count != i && meet(a, b, polygon[j], polygon[(j + 1) % count])) {
                return false;
            }
        }
    }
    return true;
}

TEST(Orientation, IsExact) {
    const glm::vec2 a(0.1f, 0.1f);
    const glm::vec2 b(0.3f, 0.3f);
    constexpr float kUp = std::numeric_limits<float>::infinity();
    for (const float x : {0.2f, 1e-30f, 1e-42f, 1e30f}) {
        EXPECT_EQ(orientation(a, b, {x, x}), 0);
        EXPECT_EQ(orientation(a, b, {x, std::nextafter(x, kUp)}), 1);
        EXPECT_EQ(orientation(a, b, {std::nextafter(x, kUp), x}), -1);
    }
    // Collinear with great differences of size, and the last bit of the smallest number decides.
    const glm::vec2 tiny(0x1p-149f, 0x1p-148f);
    EXPECT_EQ(orientation({0, 0}, tiny, {0x1p100f, 0x1p101f}), 0);
    EXPECT_EQ(orientation({0, 0}, tiny, {0x1p100f, std::nextafter(0x1p101f, kUp)}), 1);
    EXPECT_EQ(orientation({3e38f, -3e38f}, {-3e38f, 3e38f}, {1e-45f, 0}), -1);
}

TEST(Triangulate, ThreeCornersStay) {
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), Triangles({{0, 1, 2}}));
    EXPECT_EQ(triangulate({{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}), Triangles({{0, 1, 2}}));
    EXPECT_TRUE(triangulate({}).empty());
    EXPECT_TRUE(triangulate({{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST(Triangulate, QuadsAreDividedFromTheFirstCorner) {
    const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const int axis : {0, 1, 2}) {
        EXPECT_EQ(triangulate(inSpace(square, axis)), Triangles({{0, 1, 2}, {0, 2, 3}}));
    }
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0.25f}, {1, 1, 0}, {0, 1, 0.5f}}),
              Triangles({{0, 1, 2}, {0, 2, 3}}));
    // The corner that turns right is an end of the diagonal, whichever it is.
    Polygon arrow = {{-1, 0}, {0, 0.5f}, {1, 0}, {0, 2}};
    for (int i = 0; i < 4; ++i) {
        expectTriangulated(arrow);
        std::ranges::rotate(arrow, arrow.begin() + 1);
    }
}

TEST(Triangulate, CornersOnStraightSides) {
    expectTriangulated({{-1, -1}, {1, -1}, {1, 1}, {0, 0}, {-1, 1}});
    expectTriangulated({{0, 0}, {1, 0}, {2, 0}, {0, 2}});
    expectTriangulated({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {3, 1}, {2, 2}, {1, 1}});
    expectTriangulated({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
}

TEST(Triangulate, RandomSimplePolygonsOfAGrid) {
    std::mt19937 random(1);
    Polygon grid;
    for (int i = 0; i < 25; ++i) {
        grid.emplace_back(i % 5, i / 5);
    }
    int tried = 0;
    for (int round = 0; tried < 500 && round < 200000; ++round) {
        std::ranges::shuffle(grid, random);
        Polygon polygon(grid.begin(), grid.begin() + 4 + static_cast<int>(random() % 12));
        // Turns a part around where two sides cross, until none do; gives up after a while.
        for (int turn = 0; turn < 40 && !isSimple(polygon); ++turn) {
            for (std::size_t i = 0; i + 2 < polygon.size(); ++i) {
                for (std::size_t j = i + 2; j < polygon.size(); ++j) {
                    if (meet(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % polygon.size()])) {
                        std::reverse(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                     polygon.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                    }
                }
            }
        }
        if (isSimple(polygon)) {
            ++tried;
            expectTriangulated(polygon);
        }
    }
    EXPECT_EQ(tried, 500);
}

// The border of a tree of grid cells touches itself along whole sides wherever two cells of different
// branches are neighbours.
class CellTree {
  public:
    CellTree(int size, std::mt19937& random)
        : size_(size), random_(random), seen_(indexOf({0, size}), false) {
        walk({0, 0}, {0, 0});
    }

    Polygon border;
    int cells = 0;

  private:
    std::size_t indexOf(const glm::ivec2 cell) const {
        return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(size_) +
               static_cast<std::size_t>(cell.x);
    }

    // Goes around the cell counter-clockwise from its lower left corner, as seen from the cell before it, and
    // into unseen neighbours through its sides.
    void walk(glm::ivec2 cell, glm::ivec2 from) {
        seen_[indexOf(cell)] = true;
        ++cells;
        const std::array<glm::ivec2, 4> corners = {glm::ivec2(0, 0), {1, 0}, {1, 1}, {0, 1}};
        const std::array<glm::ivec2, 4> across = {glm::ivec2(0, -1), {1, 0}, {0, 1}, {-1, 0}};
        std::size_t first = 0;
        while (from != glm::ivec2(0) && across[first] != from) {
            ++first;
        }
        const std::size_t skipped = from == glm::ivec2(0) ? 0 : 1;
        for (std::size_t i = skipped; i < 4; ++i) {
            const std::size_t side = (first + i) % 4;
            border.emplace_back(cell + corners[side]);
            const glm::ivec2 other = cell + across[side];
            const bool isInside = std::min(other.x, other.y) >= 0 && std::max(other.x, other.y) < size_;
            if (isInside && !seen_[indexOf(other)] && random_() % 4 != 0) {
                walk(other, -across[side]);
            }
        }
    }

    int size_;
    std::mt19937& random_;
    std::vector<bool> seen_;
};

TEST(Triangulate, PolygonsThatTouchThemselves) {
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i) {
        const CellTree tree(2 + i % 9, random);
        ASSERT_EQ(doubleArea(tree.border), 2.0 * tree.cells);
        expectCovered(tree.border, triangulate(inSpace(tree.border)));
    }
}

TEST(Triangulate, HolesThatAreJoinedToTheBorder) {
    expectCovered({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}},
                  triangulate(inSpace(
                      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}})));
    // The hole touches the border at a corner.
    const Polygon touching = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 3}, {3, 3}, {3, 1}};
    expectCovered(touching, triangulate(inSpace(touching)));
}

TEST(Triangulate, RepeatedCornersAndSpikes) {
    const Polygon polygon = {{0, 0}, {0, 0}, {2, 0}, {5, 0}, {2, 0}, {2, 2}, {2, 2}, {2, 2}, {0, 2}, {0, 0}};
    expectCovered(polygon, triangulate(inSpace(polygon)));
    EXPECT_TRUE(triangulate(std::vector<glm::vec3>(9, glm::vec3(1.0f))).empty());
    EXPECT_TRUE(triangulate(inSpace({{0, 0}, {1, 1}, {3, 3}, {2, 2}, {5, 5}})).empty());
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}}).size(), 1u);
}

Polygon spiral(int turns, int corners) {
    Polygon polygon;
    for (const int side : {1, -1}) {
        const int steps = corners / 2;
        for (int i = 0; i < steps; ++i) {
            const int step = side > 0 ? i : steps - 1 - i;
            const double angle = 2.0 * std::numbers::pi * turns * step / steps;
            const double radius = 1.0 + angle + 0.5 * side;
            polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        }
    }
    return polygon;
}

// Teeth as long as the comb is wide.
Polygon comb(int corners) {
    Polygon polygon = {{0, -1}};
    for (int i = 0; i < corners; ++i) {
        polygon.emplace_back(i, i % 2 == 0 ? 0 : corners);
    }
    polygon.emplace_back(corners - 1, -1);
    return polygon;
}

double areaOf(const Polygon& polygon, const Triangles& triangles) {
    double sum = 0.0;
    for (const glm::uvec3& triangle : triangles) {
        sum += std::abs(doubleArea(polygon[triangle.x], polygon[triangle.y], polygon[triangle.z]));
    }
    return sum;
}

TEST(Triangulate, LargePolygons) {
    const Polygon coil = spiral(20, 10000);
    EXPECT_NEAR(areaOf(coil, triangulate(inSpace(coil))) / std::abs(doubleArea(coil)), 1.0, 1e-9);
    const Polygon teeth = comb(10001);
    EXPECT_EQ(areaOf(teeth, triangulate(inSpace(teeth))), std::abs(doubleArea(teeth)));
    Polygon disc;
    for (int i = 0; i < 10000; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 10000;
        disc.emplace_back(std::cos(angle), std::sin(angle));
    }
    EXPECT_NEAR(areaOf(disc, triangulate(inSpace(disc))) / doubleArea(disc), 1.0, 1e-9);
}

// A thin triangle whose slanted side has many corners: any triangle in it lies along all of them.
TEST(Triangulate, ThinPolygonsWithCornersOnASlantedSide) {
    const auto expectExact = [](const Polygon& polygon) {
        PolygonTriangulator triangulator;
        const std::span<const glm::uvec3> triangles = triangulator.triangulate(inSpace(polygon));
        EXPECT_FALSE(triangulator.ranOutOfWork());
        expectTriangulated(polygon, {triangles.begin(), triangles.end()});
    };
    for (const int corners : {1000, 10000}) {
        for (const glm::vec2& apex :
             {glm::vec2(1, 0), {corners, corners - 1}, {corners / 2 + 1, corners / 2}}) {
            Polygon diagonal = {apex};
            Polygon steep = {{apex.x, 3 * apex.y}};
            for (int i = corners - 1; i > 0; --i) {
                diagonal.emplace_back(i, i);
                steep.emplace_back(i, 3 * i);
            }
            expectExact(diagonal);
            expectExact(steep);
        }
        Polygon passage;
        for (int i = 0; i < corners / 2; ++i) {
            passage.emplace_back(i + 1, i);
        }
        for (int i = corners / 2 - 1; i >= 0; --i) {
            passage.emplace_back(i, i);
        }
        expectExact(passage);
        // Corners that are rounded, so they turn a little to either side; the polygon stays simple.
        Polygon rounded = {{0.2f, 0.0f}};
        for (int i = corners - 1; i > 0; --i) {
            rounded.emplace_back(0.1f * static_cast<float>(i), 0.07f * static_cast<float>(i));
        }
        EXPECT_EQ(triangulate(inSpace(rounded)).size(), rounded.size() - 2);
        EXPECT_NEAR(areaOf(rounded, triangulate(inSpace(rounded))) / std::abs(doubleArea(rounded)), 1.0,
                    1e-9);
    }
}

TEST(Triangulate, PolygonsThatCrossThemselvesEnd) {
    EXPECT_FALSE(triangulate(inSpace({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).empty());
    std::mt19937 random(1);
    std::uniform_real_distribution<float> anywhere(-1.0f, 1.0f);
    for (const int size : {5, 9, 100, 3000}) {
        std::vector<glm::vec3> corners;
        corners.reserve(static_cast<std::size_t>(size));
        for (int i = 0; i < size; ++i) {
            corners.emplace_back(anywhere(random), anywhere(random), anywhere(random));
        }
        EXPECT_FALSE(triangulate(corners).empty());
    }
}

// A star of long sides that turns right, and within it, five times around, a circle that turns left. Each
// triangle of the circle lies in the boxes of all neighbours of the star.
TEST(Triangulate, SaysWhenTheWorkRunsOut) {
    PolygonTriangulator triangulator;
    Polygon polygon;
    constexpr int kSize = 4000;
    for (int i = 0; i < kSize; ++i) {
        const double angle = -std::numbers::pi * (kSize - 1) / kSize * i;
        polygon.emplace_back(100.0 * std::cos(angle), 100.0 * std::sin(angle));
    }
    for (int i = 0; i < kSize; ++i) {
        const double angle = 10.0 * std::numbers::pi * i / kSize;
        polygon.emplace_back(90.0 * std::cos(angle), 90.0 * std::sin(angle));
    }
    EXPECT_FALSE(triangulator.triangulate(inSpace(polygon)).empty());
    EXPECT_TRUE(triangulator.ranOutOfWork());
    triangulator.triangulate(inSpace({{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_FALSE(triangulator.ranOutOfWork());
}

// In a slanted plane the corners are rounded, and the area along the axis stays exact.
TEST(Triangulate, TinyAndFarPolygons) {
    for (const float far : {0.0f, 1e6f, 1e30f}) {
        const float unit = std::max(std::nextafter(far, 2.0f * far + 1.0f) - far, 1e-45f);
        std::vector<glm::vec3> corners;
        for (const glm::vec2 point : {glm::vec2(0, 0), {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) {
            corners.emplace_back(far + unit * point.x, far + unit * point.y, far);
        }
        EXPECT_EQ(triangulate(corners).size(), 4u);
    }
}

TEST(Triangulate, CornersThatAreNotFiniteGiveAFan) {
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, NAN, 0}, {1, 1, 0}, {0, 1, INFINITY}}),
              Triangles({{0, 1, 2}, {0, 2, 3}}));
}

} // namespace
} // namespace metamarch
