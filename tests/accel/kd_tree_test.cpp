// SPDX-License-Identifier: MIT
// All users of the tree rely on this: its leaves tile the lattice, and each lists all of its triangles.
#include "accel/overlap.h"
#include "fixtures/named_scene.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>

namespace metamarch::tests {
namespace {

Scene soup() { return triangleSoup(600, 1); }

Scene moved(Scene scene, const glm::vec3 offset) {
    for (glm::vec3& position : scene.positions) {
        position += offset;
    }
    return scene;
}

Scene flatSoup() {
    Scene scene = soup();
    for (glm::vec3& position : scene.positions) {
        position.y = 0.25f;
    }
    return scene;
}

Scene sphereOnPlane() { return sphereOnFloor(24, 12, 100.0f); }

AccelerationOptions withUnit(const glm::dvec3 unit) { return {unit, {}, {}}; }
AccelerationOptions withQuantum(const double quantum) {
    AccelerationOptions options;
    options.table = TableMethod::gcd;
    options.quantum = quantum;
    return options;
}
AccelerationOptions withDepth(const unsigned depth) { return {{}, {}, depth}; }

const NamedScene kCases[] = {
    {"empty", noTriangles, {}},
    {"unit_cube", unitCube, {}},
    {"unit_cube_integer_planes", unitCube, withUnit(glm::dvec3(0.125))},
    {"unit_cube_one_cell", unitCube, withUnit(glm::dvec3(5.0))},
    {"soup", soup, {}},
    {"soup_fine", [] { return triangleSoup(150, 2); }, {{}, 500000u, kMaxTreeDepth}},
    {"soup_anisotropic", soup, withUnit({0.01, 0.3, 0.05})},
    {"soup_flat", flatSoup, {}},
    {"soup_no_depth", soup, withDepth(0)},
    {"soup_depth_1", soup, withDepth(1)},
    {"soup_depth_7", soup, withDepth(7)},
    {"soup_deepest", soup, withDepth(kMaxTreeDepth)},
    {"soup_far_away",
     [] {
         return moved(soup(), {1e4f, -1e5f, 3e4f});
     },
     {}},
    {"sphere_on_plane", sphereOnPlane, {}},
    {"empty_gcd", noTriangles, withQuantum(0.25)},
    {"unit_cube_gcd", unitCube, withQuantum(0.125)},
    {"soup_gcd", soup, withQuantum(1.0 / 200.0)},
    {"soup_gcd_coarse", soup, withQuantum(0.2)},
    {"sphere_on_plane_gcd", sphereOnPlane, withQuantum(0.5)},
};

class Tree : public testing::TestWithParam<NamedScene> {
  protected:
    const Scene scene = GetParam().make();
    const AccelerationStructure structure = buildAccelerationStructure(scene, GetParam().options);
    const KdTree& tree = structure.tree;
};

// Visits the nodes in array order, each with the box that the planes above it leave.
class TreeWalk {
  public:
    explicit TreeWalk(const KdTree& walkedTree) : tree(walkedTree) {}

    void visit(const glm::ivec3 lo, const glm::ivec3 hi, const unsigned depth) {
        ASSERT_LT(nodes, tree.nodes.size());
        const KdNode node = tree.nodes[nodes++];
        deepest = std::max(deepest, depth);
        if (isLeaf(node)) {
            ASSERT_EQ(leafOf(node), leaves++) << "leaves are numbered in the order of the nodes";
            EXPECT_EQ(unpackCell(tree.leaves[leafOf(node)].lo), lo);
            EXPECT_EQ(unpackCell(tree.leaves[leafOf(node)].hi), hi);
            return;
        }
        const int axis = static_cast<int>(splitAxis(node));
        const int plane = static_cast<int>(splitPlane(node));
        ASSERT_LT(axis, 3);
        ASSERT_GT(plane, lo[axis]);
        ASSERT_LT(plane, hi[axis]);
        glm::ivec3 middleLo = lo;
        glm::ivec3 middleHi = hi;
        middleLo[axis] = middleHi[axis] = plane;
        ASSERT_NO_FATAL_FAILURE(visit(lo, middleHi, depth + 1)); // the next node is the child below
        ASSERT_EQ(childAbove(node), nodes);
        ASSERT_NO_FATAL_FAILURE(visit(middleLo, hi, depth + 1));
    }

    std::size_t nodes = 0;
    std::size_t leaves = 0;
    unsigned deepest = 0;

  private:
    const KdTree& tree;
};

TEST_P(Tree, liesInDepthFirstOrder) {
    TreeWalk walk(tree);
    ASSERT_NO_FATAL_FAILURE(walk.visit(glm::ivec3(0), glm::ivec3(structure.lattice.resolution), 0));
    EXPECT_EQ(walk.nodes, tree.nodes.size());
    EXPECT_EQ(walk.leaves, tree.leaves.size());
    EXPECT_EQ(walk.deepest, tree.depth);
}

TEST_P(Tree, keepsTheDepthLimit) {
    const std::size_t triangles = nonDegenerateTriangles(scene).size();
    const unsigned limit =
        GetParam().options.treeDepth.value_or(defaultTreeDepth(static_cast<std::uint32_t>(triangles)));
    EXPECT_LE(limit, kMaxTreeDepth);
    EXPECT_LE(tree.depth, limit);
    if (limit == 0) {
        ASSERT_EQ(tree.leaves.size(), 1u);
        EXPECT_EQ(tree.leaves[0].triangleCount, triangles);
    }
}

TEST_P(Tree, hasLeavesThatTileTheLattice) {
    std::vector<unsigned> leavesOfCell(structure.lattice.cellCount, 0);
    for (const Leaf& leaf : tree.leaves) {
        const glm::ivec3 lo = unpackCell(leaf.lo);
        const glm::ivec3 hi = unpackCell(leaf.hi);
        ASSERT_TRUE(glm::all(glm::lessThan(lo, hi)));
        ASSERT_TRUE(glm::all(glm::lessThanEqual(glm::uvec3(hi), structure.lattice.resolution)));
        for (glm::ivec3 cell = lo; cell.z < hi.z; ++cell.z) {
            for (cell.y = lo.y; cell.y < hi.y; ++cell.y) {
                for (cell.x = lo.x; cell.x < hi.x; ++cell.x) {
                    ++leavesOfCell[cellIndex(cell, structure.lattice.resolution)];
                }
            }
        }
    }
    EXPECT_EQ(std::count(leavesOfCell.begin(), leavesOfCell.end(), 1u), structure.lattice.cellCount);
}

std::span<const std::uint32_t> trianglesOf(const KdTree& tree, const Leaf& leaf) {
    return std::span(tree.leafTriangles).subspan(leaf.firstTriangle, leaf.triangleCount);
}

void expectAscendingTriangles(const KdTree& tree) {
    std::size_t next = 0;
    for (const Leaf& leaf : tree.leaves) {
        ASSERT_EQ(leaf.firstTriangle, next);
        next += leaf.triangleCount;
        ASSERT_LE(next, tree.leafTriangles.size());
        const auto ids = trianglesOf(tree, leaf);
        ASSERT_EQ(std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()), ids.end());
    }
    EXPECT_EQ(next, tree.leafTriangles.size());
}

TEST_P(Tree, listsAscendingTrianglesOneLeafAfterTheOther) { expectAscendingTriangles(tree); }

// No missing and no needless test: a leaf lists a triangle if and only if the triangle comes within the
// margin.
TEST_P(Tree, listsTheTrianglesThatMeetTheGrownLeaf) {
    const glm::dvec3 margin = referenceMargin(structure.lattice);
    for (const std::uint32_t id : nonDegenerateTriangles(scene)) {
        LatticeTriangle triangle;
        for (int corner = 0; corner < 3; ++corner) {
            triangle[static_cast<std::size_t>(corner)] =
                toLattice(structure.lattice, scene.positions[scene.triangles[id][corner]]);
        }
        std::size_t leavesOfTriangle = 0;
        for (const Leaf& leaf : tree.leaves) {
            const glm::dvec3 lo(unpackCell(leaf.lo));
            const glm::dvec3 hi(unpackCell(leaf.hi));
            const glm::dvec3 least = margin * (1.0 - kMarginRounding);
            const glm::dvec3 most = margin * (1.0 + kMarginRounding);
            const auto ids = trianglesOf(tree, leaf);
            const bool listed = std::binary_search(ids.begin(), ids.end(), id);
            leavesOfTriangle += listed ? 1 : 0;
            if (listed) {
                ASSERT_TRUE(overlaps(triangle, {lo - most, hi + most}))
                    << "triangle " << id << " does not come near leaf " << &leaf - tree.leaves.data();
            } else {
                ASSERT_FALSE(overlaps(triangle, {lo - least, hi + least}))
                    << "triangle " << id << " is missing from leaf " << &leaf - tree.leaves.data();
            }
        }
        EXPECT_GT(leavesOfTriangle, 0u);
    }
}

TEST_P(Tree, hasRecordsOfTheTrianglesInLeafOrder) {
    ASSERT_EQ(structure.triangles.size(), tree.leafTriangles.size());
    for (std::size_t recordIndex = 0; recordIndex < tree.leafTriangles.size(); ++recordIndex) {
        const TriangleRecord& record = structure.triangles[recordIndex];
        const glm::uvec3 indices = scene.triangles[tree.leafTriangles[recordIndex]];
        ASSERT_EQ(record.triangleId, tree.leafTriangles[recordIndex]);
        ASSERT_EQ(record.v0, scene.positions[indices.x]);
        ASSERT_EQ(record.v1, scene.positions[indices.y]);
        ASSERT_EQ(record.v2, scene.positions[indices.z]);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Tree, testing::ValuesIn(kCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(TreeDepth, isTheOneThatWasSuggested) {
    EXPECT_EQ(defaultTreeDepth(0), 8u);
    EXPECT_EQ(defaultTreeDepth(1), 8u);
    EXPECT_EQ(defaultTreeDepth(69451), 29u);
    EXPECT_EQ(defaultTreeDepth(0xffffffffu), kMaxTreeDepth);
}

template <class T>
void expectSameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b))));
}

AccelerationStructure buildOnThreads(const Scene& scene, const int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return buildAccelerationStructure(scene, {}); });
}

TEST(TreeThreads, doNotChangeTheTree) {
    // Large enough for the builder to use several threads.
    const Scene scene = triangleSoup(60000, 4);
    const AccelerationStructure one = buildOnThreads(scene, 1);
    expectAscendingTriangles(one.tree);
    for (const int threads : {2, 4}) {
        SCOPED_TRACE(threads);
        const AccelerationStructure several = buildOnThreads(scene, threads);
        expectSameBytes(several.tree.nodes, one.tree.nodes);
        expectSameBytes(several.tree.leaves, one.tree.leaves);
        expectSameBytes(several.tree.leafTriangles, one.tree.leafTriangles);
        expectSameBytes(several.table.words, one.table.words);
        expectSameBytes(several.table.leaves, one.table.leaves);
        expectSameBytes(several.triangles, one.triangles);
        EXPECT_EQ(several.tree.depth, one.tree.depth);
    }
}

} // namespace
} // namespace metamarch::tests
