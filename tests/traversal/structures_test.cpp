// SPDX-License-Identifier: MIT
// The structures of the traversals other than the meta table: a ray can find every triangle in each of them.
#include "fixtures/named_scene.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/structure_set.h"
#include "metamarch/shared/kd_rope.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

namespace metamarch::tests {
namespace {

// All triangles are at the same place, so no split separates them.
Scene identicalTriangles(const int count) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
        addTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0.25f});
    }
    return scene;
}

// Size and distance double from triangle to triangle, so each split separates only one of them.
Scene geometricSeries() {
    Scene scene;
    for (int i = 0; i < 2000; ++i) {
        const float x = std::ldexp(1.0f, i % 60 - 30);
        const float y = 1e-3f * static_cast<float>(i);
        addTriangle(scene, {x, y, 0}, {2 * x, y, 0}, {x, y + x, x});
    }
    return scene;
}

const NamedScene kScenes[] = {
    {"unit_cube", unitCube},
    {"soup", [] { return triangleSoup(3000, 4); }},
    {"identical", [] { return identicalTriangles(1000); }},
    {"geometric_series", geometricSeries},
    {"empty", noTriangles},
};

class Structures : public testing::TestWithParam<NamedScene> {
  protected:
    const Scene scene = GetParam().make();
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const StructureSet structures{structure};
    const Lattice& lattice = structure.lattice;

    std::array<glm::dvec3, 3> corners(const TriangleRecord& triangle) const {
        return {toLattice(lattice, triangle.v0), toLattice(lattice, triangle.v1),
                toLattice(lattice, triangle.v2)};
    }

    // Calls visit(rope, first, last) for each face of each leaf, with the first and the last cell behind it.
    // Stops at the first failure.
    template <class Visit>
    void forEachFace(const Visit& visit) const {
        const std::vector<std::uint32_t>& ropes = structures.kdRopes();
        for (std::uint32_t leafId = 0; leafId < structure.tree.leaves.size(); ++leafId) {
            const ivec3 lo = unpackCell(structure.tree.leaves[leafId].lo);
            const ivec3 hi = unpackCell(structure.tree.leaves[leafId].hi);
            for (int axis = 0; axis < 3; ++axis) {
                for (const int outside : {lo[axis] - 1, hi[axis]}) {
                    ivec3 first = lo;
                    ivec3 last = hi - 1;
                    first[axis] = last[axis] = outside;
                    visit(ropes[ropeTowards(leafId, first, lo, hi)], first, last);
                    if (HasFatalFailure()) {
                        return;
                    }
                }
            }
        }
    }
};

TEST_P(Structures, holdTheNonDegenerateTriangles) {
    const std::vector<std::uint32_t> nonDegenerate = nonDegenerateTriangles(scene);
    const auto ids = [](const std::vector<TriangleRecord>& records) {
        std::vector<std::uint32_t> found;
        for (const TriangleRecord& record : records) {
            found.push_back(record.triangleId);
        }
        return found;
    };
    EXPECT_EQ(ids(structures.triangles()), nonDegenerate);
    std::vector<std::uint32_t> inBvh = ids(structures.bvh().triangles);
    std::ranges::sort(inBvh);
    EXPECT_EQ(inBvh, nonDegenerate);
}

// The driver's hierarchy gets every triangle once, in the order of its first reference in the leaves.
TEST_P(Structures, spatialTrianglesAreInTheOrderOfTheLeaves) {
    std::set<std::uint32_t> seen;
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t id : structure.tree.leafTriangles) {
        if (seen.insert(id).second) {
            expected.push_back(id);
        }
    }
    std::vector<std::uint32_t> found;
    for (const TriangleRecord& record : structures.spatialTriangles()) {
        found.push_back(record.triangleId);
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(found.size(), nonDegenerateTriangles(scene).size());
}

// Every child's box contains its triangles with the margin, and the tree is not deeper than the stack.
TEST_P(Structures, bvhBoxesHoldTheirTriangles) {
    const Bvh& bvh = structures.bvh();
    const glm::dvec3 margin = referenceMargin(lattice);
    EXPECT_LE(bvh.depth, kMaxBvhDepth);
    std::size_t reached = 0;
    const auto check = [&](const auto& self, const std::uint32_t child, const glm::dvec3 lo,
                           const glm::dvec3 hi) -> void {
        if (!isBvhLeaf(child)) {
            const BvhNode& node = bvh.nodes[child];
            self(self, node.child0, glm::max(lo, glm::dvec3(node.lo0)), glm::min(hi, glm::dvec3(node.hi0)));
            self(self, node.child1, glm::max(lo, glm::dvec3(node.lo1)), glm::min(hi, glm::dvec3(node.hi1)));
            return;
        }
        for (std::uint32_t i = 0; i < bvhTriangleCount(child); ++i) {
            ++reached;
            for (const glm::dvec3 corner : corners(bvh.triangles[bvhFirstTriangle(child) + i])) {
                EXPECT_TRUE(glm::all(glm::lessThanEqual(lo, corner - margin)));
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(hi, corner + margin)));
            }
        }
    };
    check(check, 0, glm::dvec3(-1e30), glm::dvec3(1e30));
    EXPECT_EQ(reached, bvh.triangles.size());
}

// Every child's box, as bytes of its node, contains its triangles with the margin. The sums of plane and
// origin are exact in double precision.
TEST_P(Structures, wideBvhBoxesHoldTheirTriangles) {
    const std::vector<WideBvhNode>& nodes = structures.wideBvh();
    const std::vector<TriangleRecord>& triangles = structures.bvh().triangles;
    const glm::dvec3 margin = referenceMargin(lattice);
    std::size_t reached = 0;
    const auto check = [&](const auto& self, const std::uint32_t nodeId, const unsigned depth) -> void {
        ASSERT_LE(depth, kMaxBvhDepth);
        const WideBvhNode& node = nodes[nodeId];
        const glm::dvec3 step(wideStep(node.steps, 0), wideStep(node.steps, 1), wideStep(node.steps, 2));
        const auto plane = [&](const uvec3 words, const std::uint32_t i) {
            return glm::dvec3(node.origin) + glm::dvec3((words >> (8u * i)) & 0xffu) * step;
        };
        const std::uint32_t children[] = {node.child0, node.child1, node.child2, node.child3};
        for (std::uint32_t i = 0; i < kWideChildren; ++i) {
            if (!isBvhLeaf(children[i])) {
                ASSERT_GT(children[i], nodeId);
                self(self, children[i], depth + 1);
                continue;
            }
            for (std::uint32_t k = 0; k < bvhTriangleCount(children[i]); ++k) {
                ++reached;
                for (const glm::dvec3 corner : corners(triangles[bvhFirstTriangle(children[i]) + k])) {
                    EXPECT_TRUE(glm::all(glm::lessThanEqual(plane(node.lo, i), corner - margin)));
                    EXPECT_TRUE(glm::all(glm::greaterThanEqual(plane(node.hi, i), corner + margin)));
                }
            }
        }
    };
    check(check, 0, 1);
    EXPECT_EQ(reached, triangles.size());
}

TEST_P(Structures, bvhDoesNotDependOnThreads) {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    const Bvh serial = buildBvh(lattice, structures.triangles());
    const Bvh& parallel = structures.bvh();
    ASSERT_EQ(serial.nodes.size(), parallel.nodes.size());
    EXPECT_EQ(std::memcmp(serial.nodes.data(), parallel.nodes.data(), serial.nodes.size() * sizeof(BvhNode)),
              0);
}

// A cell lists the triangles that come within the margin of it, and no others.
TEST_P(Structures, gridCellsListTheirTriangles) {
    const UniformGrid& grid = structures.uniformGrid();
    const uvec3 resolution = grid.grid.resolution;
    const glm::dvec3 scale(grid.grid.scale);
    ASSERT_EQ(grid.cells.size(), grid.grid.cellCount);
    std::vector<std::set<std::uint32_t>> expected(grid.cells.size());
    for (const TriangleRecord& triangle : structures.triangles()) {
        LatticeTriangle inGrid = corners(triangle);
        for (glm::dvec3& corner : inGrid) {
            corner *= scale;
        }
        const CellCorner last = {static_cast<std::uint16_t>(resolution.x - 1),
                                 static_cast<std::uint16_t>(resolution.y - 1),
                                 static_cast<std::uint16_t>(resolution.z - 1)};
        const glm::dvec3 margin = referenceMargin(lattice) * scale;
        const auto range = touchedCells(inGrid, {{0, 0, 0}, last}, margin);
        ASSERT_TRUE(range);
        for (std::uint16_t z = range->lo[2]; z <= range->hi[2]; ++z) {
            for (std::uint16_t y = range->lo[1]; y <= range->hi[1]; ++y) {
                for (std::uint16_t x = range->lo[0]; x <= range->hi[0]; ++x) {
                    if (touchedCells(inGrid, {{x, y, z}, {x, y, z}}, margin)) {
                        expected[cellIndex(ivec3(x, y, z), resolution)].insert(triangle.triangleId);
                    }
                }
            }
        }
    }
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        std::set<std::uint32_t> listed;
        for (std::uint32_t k = 0; k < grid.cells[i].triangleCount; ++k) {
            listed.insert(grid.triangles[grid.cells[i].firstTriangle + k].triangleId);
        }
        EXPECT_EQ(listed.size(), grid.cells[i].triangleCount) << "a triangle is listed twice in cell " << i;
        EXPECT_EQ(listed, expected[i]) << "cell " << i;
    }
}

// One step out of every cell at a leaf's face, the rope's node contains the leaf that the table has there.
TEST_P(Structures, ropesLeadToTheNeighbours) {
    const KdTree& tree = structure.tree;
    forEachFace([&](std::uint32_t nodeId, const ivec3& first, const ivec3& last) {
        for (const ivec3& cell : {first, last}) {
            ASSERT_EQ(nodeId != kNoRope, isInLattice(cell, lattice.resolution));
            if (nodeId == kNoRope) {
                continue;
            }
            std::uint32_t below = nodeId;
            while (!isLeaf(tree.nodes[below])) {
                below = childWithCell(below, tree.nodes[below], cell);
            }
            ASSERT_EQ(leafOf(tree.nodes[below]), structure.table.leafAt(cell));
        }
    });
}

// No child of a rope's node holds all that is behind the face: the face's first and last cell are in
// different ones.
TEST_P(Structures, ropesLeadToTheSmallestNode) {
    const KdTree& tree = structure.tree;
    forEachFace([&](std::uint32_t nodeId, const ivec3& first, const ivec3& last) {
        if (nodeId != kNoRope && !isLeaf(tree.nodes[nodeId])) {
            ASSERT_NE(childWithCell(nodeId, tree.nodes[nodeId], first),
                      childWithCell(nodeId, tree.nodes[nodeId], last));
        }
    });
}

TEST_P(Structures, parentsHoldTheirChildren) {
    const KdTree& tree = structure.tree;
    const std::vector<KdParent>& parents = structures.kdParents();
    ASSERT_EQ(parents.size(), tree.nodes.size());
    EXPECT_EQ(parents[0].parent, 0u);
    for (std::uint32_t nodeId = 0; nodeId < tree.nodes.size(); ++nodeId) {
        const KdNode& node = tree.nodes[nodeId];
        if (isLeaf(node)) {
            EXPECT_EQ(parents[nodeId].lo, tree.leaves[leafOf(node)].lo);
            EXPECT_EQ(parents[nodeId].hi, tree.leaves[leafOf(node)].hi);
        } else {
            EXPECT_EQ(parents[nodeId + 1].parent, nodeId);
            EXPECT_EQ(parents[childAbove(node)].parent, nodeId);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Structures, testing::ValuesIn(kScenes),
                         [](const auto& instance) { return std::string(instance.param.name); });

} // namespace
} // namespace metamarch::tests
