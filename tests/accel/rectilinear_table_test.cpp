// SPDX-License-Identifier: MIT
// The rectilinear table: keeps a kd-tree's planes unchanged; checked cell by cell.
#include "fixtures/expect_error.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/rectilinear_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <regex>
#include <set>

namespace metamarch::tests {
namespace {

struct Made {
    Lattice lattice;
    std::vector<TriangleRecord> triangles;
    std::vector<LatticeTriangle> corners; // of the triangles
    RectilinearTable table;
};

Made make(const Scene& scene, const RectilinearDepth depth, const bool exitBoxes = false) {
    std::vector<TriangleRecord> triangles = makeTriangleRecords(scene, nonDegenerateTriangles(scene));
    const Lattice lattice =
        makeLattice(boundsOf(scene), static_cast<std::uint32_t>(triangles.size()), {}).lattice;
    std::vector<LatticeTriangle> corners;
    corners.reserve(triangles.size());
    for (const TriangleRecord& triangle : triangles) {
        corners.push_back({toLattice(lattice, triangle.v0), toLattice(lattice, triangle.v1),
                           toLattice(lattice, triangle.v2)});
    }
    RectilinearTable table = buildRectilinearTable(lattice, triangles, depth, exitBoxes);
    return {lattice, std::move(triangles), std::move(corners), std::move(table)};
}

constexpr RectilinearDepth wanted(const unsigned depth) { return {depth, true}; }

template <class Visit>
void forEachCell(const glm::uvec3 resolution, const Visit& visit) {
    glm::ivec3 cell;
    for (cell.z = 0; cell.z < static_cast<int>(resolution.z); ++cell.z) {
        for (cell.y = 0; cell.y < static_cast<int>(resolution.y); ++cell.y) {
            for (cell.x = 0; cell.x < static_cast<int>(resolution.x); ++cell.x) {
                visit(cell);
            }
        }
    }
}

const Leaf& leafAt(const RectilinearTable& table, const glm::ivec3 cell) {
    return table.table.leaves[table.table.leafAt(cell)];
}

TEST(RectilinearTable, hasThePlanesOfTheTreeToTheBit) {
    for (const Scene& scene : {triangleSoup(3000, 6), unitCube()}) {
        const Made made = make(scene, wanted(9));
        const SplitPlan plan = planSplits(made.lattice, made.corners, 9);
        std::array<std::set<float>, 3> expected;
        for (const PlannedNode& node : plan.nodes) {
            if (node.axis != kNoSplit) {
                expected[node.axis].insert(static_cast<float>(node.plane));
            }
        }
        EXPECT_EQ(made.table.depth, plan.depth);
        for (int axis = 0; axis < 3; ++axis) {
            const int resolution = static_cast<int>(made.table.planes.layout().resolution[axis]);
            std::set<float> inner;
            for (int i = 1; i < resolution; ++i) {
                inner.insert(made.table.planes.plane(axis, i));
            }
            EXPECT_EQ(inner, expected[static_cast<std::size_t>(axis)]) << "axis " << axis;
            EXPECT_EQ(made.table.planes.plane(axis, 0), 0.0f);
            EXPECT_EQ(made.table.planes.plane(axis, resolution),
                      static_cast<float>(made.lattice.resolution[axis]));
        }
    }
}

// Returns the node of the plan that contains a point.
std::size_t plannedLeaf(const SplitPlan& plan, const glm::vec3 point) {
    std::size_t node = 0;
    while (plan.nodes[node].axis != kNoSplit) {
        const PlannedNode& split = plan.nodes[node];
        const bool above = point[static_cast<int>(split.axis)] >= static_cast<float>(split.plane);
        node = above ? split.above : node + 1;
    }
    return node;
}

// All cells of a leaf of the tree name the same leaf of the table. Several leaves of the tree share one only
// if they are empty, where only the margin kept them apart.
TEST(RectilinearTable, carriesTheTreeExactly) {
    const Made made = make(triangleSoup(2000, 6), wanted(10));
    const SplitPlan plan = planSplits(made.lattice, made.corners, 10);
    const RectilinearPlanes& planes = made.table.planes;
    std::map<std::size_t, std::uint32_t> tableLeafOf;
    std::map<std::uint32_t, std::set<std::size_t>> plannedOf;
    forEachCell(planes.layout().resolution, [&](const glm::ivec3 cell) {
        const glm::vec3 corner(planes.plane(0, cell.x), planes.plane(1, cell.y), planes.plane(2, cell.z));
        const std::size_t planned = plannedLeaf(plan, corner);
        const std::uint32_t leafId = made.table.table.leafAt(cell);
        ASSERT_EQ(tableLeafOf.emplace(planned, leafId).first->second, leafId);
        plannedOf[leafId].insert(planned);
    });
    EXPECT_EQ(plannedOf.size(), made.table.table.leaves.size());
    EXPECT_GT(plannedOf.size(), 500u);
    for (const auto& [leafId, planned] : plannedOf) {
        EXPECT_TRUE(planned.size() == 1 || made.table.table.leaves[leafId].triangleCount == 0);
    }
}

TEST(RectilinearTable, everyCellNamesALeafThatHoldsIt) {
    for (const bool exitBoxes : {false, true}) {
        const Made made = make(triangleSoup(2000, 6), wanted(10), exitBoxes);
        const glm::uvec3 resolution = made.table.planes.layout().resolution;
        std::size_t volume = 0; // total volume of the leaves
        for (const Leaf& leaf : made.table.table.leaves) {
            const glm::ivec3 size = unpackCell(leaf.hi) - unpackCell(leaf.lo);
            volume += static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                      static_cast<std::size_t>(size.z);
        }
        EXPECT_EQ(volume == made.table.planes.layout().cellCount,
                  !exitBoxes); // the leaves tile the lattice, exit boxes overlap
        forEachCell(resolution, [&](const glm::ivec3 cell) {
            const Leaf& leaf = leafAt(made.table, cell);
            ASSERT_TRUE(glm::all(glm::lessThanEqual(unpackCell(leaf.lo), cell)));
            ASSERT_TRUE(glm::all(glm::lessThan(cell, unpackCell(leaf.hi))));
        });
    }
}

// A leaf lists all triangles within the margin of the box that a ray may cross after testing the leaf.
TEST(RectilinearTable, leavesListWhatComesWithinTheMargin) {
    for (const bool exitBoxes : {false, true}) {
        const Made made = make(triangleSoup(400, 3), wanted(8), exitBoxes);
        const glm::dvec3 margin = (1.0 - 1e-6) * referenceMargin(made.lattice);
        const RectilinearPlanes& planes = made.table.planes;
        const auto planesAt = [&](const glm::ivec3 cell) {
            return glm::dvec3(planes.plane(0, cell.x), planes.plane(1, cell.y), planes.plane(2, cell.z));
        };
        for (const Leaf& leaf : made.table.table.leaves) {
            std::set<std::uint32_t> listed;
            for (std::uint32_t i = 0; i < leaf.triangleCount; ++i) {
                listed.insert(made.table.table.triangles[leaf.firstTriangle + i].triangleId);
            }
            EXPECT_EQ(listed.size(), leaf.triangleCount);
            const Box box{planesAt(unpackCell(leaf.lo)) - margin, planesAt(unpackCell(leaf.hi)) + margin};
            for (std::size_t i = 0; i < made.triangles.size(); ++i) {
                ASSERT_TRUE(!clipTriangle(made.corners[i], box) ||
                            listed.contains(made.triangles[i].triangleId));
            }
        }
    }
}

TEST(RectilinearTable, ofAnEmptySceneIsOneEmptyCell) {
    for (const RectilinearDepth depth : {RectilinearDepth{20, true}, RectilinearDepth{20, false}}) {
        const RectilinearTable table = make({}, depth, true).table;
        EXPECT_EQ(table.planes.layout().resolution, glm::uvec3(1));
        EXPECT_EQ(table.table.words, std::vector<std::uint32_t>(4, 0)); // a whole load
        ASSERT_EQ(table.table.leaves.size(), 1u);
        EXPECT_EQ(table.table.leaves[0].triangleCount, 0u);
        EXPECT_TRUE(table.table.triangles.empty());
        EXPECT_EQ(table.depth, 0u);
    }
}

TEST(RectilinearTable, ofOneTriangleHoldsItOnce) {
    Scene scene;
    addTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0.25f});
    const RectilinearTable table = make(scene, {20, false}).table;
    ASSERT_EQ(table.table.triangles.size(), 1u);
    EXPECT_EQ(table.table.triangles[0].triangleId, 0u);
    EXPECT_EQ(
        std::ranges::count_if(table.table.leaves, [](const Leaf& leaf) { return leaf.triangleCount == 1; }),
        1);
}

// The message tells the size that the requested depth needs, and the depth that it offers instead fits.
TEST(RectilinearTable, refusesADepthThatDoesNotFitWithItsSize) {
    const Scene scene = triangleSoup(6000, 3);
    const Error error = errorOf(ErrorKind::outOfMemory, [&] { make(scene, wanted(20)); });
    EXPECT_EQ(error.settings, SettingNames({"treeDepth"}));
    const std::string line = error.what();
    std::smatch words;
    ASSERT_TRUE(std::regex_match(
        line, words,
        std::regex(R"(a rectilinear table of tree depth 20 has (\d+) x (\d+) x (\d+) cells \((\d+) MiB\), )"
                   R"(more than 1023 on an axis or 1024 MiB; the deepest that fits is (\d+))")))
        << line;
    const double cells = std::stod(words[1]) * std::stod(words[2]) * std::stod(words[3]);
    EXPECT_NEAR(std::stod(words[4]), cells * sizeof(std::uint32_t) / 0x1p20, 1.0);
    const auto deepest = static_cast<unsigned>(std::stoul(words[5]));
    EXPECT_EQ(make(scene, wanted(deepest)).table.depth, deepest);
    expectError(ErrorKind::outOfMemory, fmt::format("the deepest that fits is {}", deepest),
                [&] { make(scene, wanted(deepest + 1)); });
}

// The deepest tree that fits is the one whose next level does not fit.
TEST(RectilinearTable, takesTheDeepestTreeThatFits) {
    const Scene scene = triangleSoup(6000, 3);
    const Made made = make(scene, {kMaxTreeDepth, false});
    EXPECT_LE(made.table.planes.layout().cellCount, kMostAutomaticCells);
    const SplitPlan plan = planSplits(made.lattice, made.corners, made.table.depth + 1);
    std::array<std::set<float>, 3> planes;
    for (const PlannedNode& node : plan.nodes) {
        if (node.axis != kNoSplit) {
            planes[node.axis].insert(static_cast<float>(node.plane));
        }
    }
    double cells = 1.0;
    bool overAnAxis = false;
    for (const std::set<float>& axis : planes) {
        cells *= static_cast<double>(axis.size() + 1);
        overAnAxis = overAnAxis || axis.size() + 1 > kMaxLatticeResolution;
    }
    EXPECT_TRUE(overAnAxis || cells > kMostAutomaticCells);
    // A limit below that depth is respected.
    EXPECT_EQ(make(scene, {5, false}).table.depth, 5u);
    EXPECT_EQ(make(scene, {0, false}).table.planes.layout().cellCount, 1u);
}

TEST(RectilinearTable, doesNotDependOnThreads) {
    const Scene scene = triangleSoup(20000, 4);
    const auto makeOn = [&](const std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return make(scene, wanted(8), true).table;
    };
    const RectilinearTable one = makeOn(1);
    const RectilinearTable four = makeOn(4);
    EXPECT_EQ(one.planes.planes(), four.planes.planes());
    EXPECT_EQ(one.table.words, four.table.words);
    ASSERT_EQ(one.table.leaves.size(), four.table.leaves.size());
    EXPECT_EQ(std::memcmp(one.table.leaves.data(), four.table.leaves.data(),
                          one.table.leaves.size() * sizeof(Leaf)),
              0);
    EXPECT_TRUE(std::ranges::equal(one.table.triangles, four.table.triangles, {}, &TriangleRecord::triangleId,
                                   &TriangleRecord::triangleId));
}

} // namespace
} // namespace metamarch::tests
