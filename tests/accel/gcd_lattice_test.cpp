// SPDX-License-Identifier: MIT
// Method 2: the tree's own planes, rounded to quanta, and the lattice that contains them all.
#include "fixtures/expect_error.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/gcd_lattice.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace metamarch::tests {
namespace {

std::vector<LatticeTriangle> cornersIn(const Lattice& lattice, const Scene& scene) {
    std::vector<LatticeTriangle> corners;
    for (const TriangleRecord& triangle : makeTriangleRecords(scene, nonDegenerateTriangles(scene))) {
        corners.push_back({toLattice(lattice, triangle.v0), toLattice(lattice, triangle.v1),
                           toLattice(lattice, triangle.v2)});
    }
    return corners;
}

Lattice quantaOf(const Scene& scene, const double quantum) {
    return makeQuantumLattice(boundsOf(scene), static_cast<std::uint32_t>(scene.triangles.size()), quantum)
        .lattice;
}

AccelerationOptions withQuantum(const double quantum) {
    AccelerationOptions options;
    options.table = TableMethod::gcd;
    options.quantum = quantum;
    return options;
}

// Returns a box of 16 x 16 x 16 quanta.
Lattice sixteenQuanta() {
    Scene scene;
    addTriangle(scene, {0, 0, 0}, {16, 16, 0}, {0, 16, 16});
    return quantaOf(scene, 1.0);
}

constexpr PlannedNode kLeaf{kNoSplit, 0.0, 0};

TEST(GcdLattice, dividesByWhatAllPlanesOfAnAxisShare) {
    // Planes at x = 4 and 12 and at y = 6; none across z.
    const SplitPlan plan{{{0, 4.1, 2}, kLeaf, {1, 5.8, 4}, kLeaf, {0, 11.7, 6}, kLeaf, kLeaf}, 3};
    const GcdLattice gcd = makeGcdLattice(sixteenQuanta(), plan);
    EXPECT_EQ(gcd.rounding.quantaPerCell, glm::uvec3(4, 6, 16));
    EXPECT_EQ(gcd.lattice.resolution, glm::uvec3(4, 3, 1));
    EXPECT_NEAR(gcd.rounding.quantum, 1.0, 1e-4);
    EXPECT_NEAR(gcd.rounding.farthest, 0.5, 1e-4);
    ASSERT_EQ(gcd.plan.nodes.size(), plan.nodes.size());
    const double expected[] = {1, 0, 1, 0, 3, 0, 0};
    for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
        EXPECT_EQ(gcd.plan.nodes[i].axis, plan.nodes[i].axis);
        EXPECT_EQ(gcd.plan.nodes[i].plane, expected[i]);
        EXPECT_EQ(gcd.plan.nodes[i].above, plan.nodes[i].above);
    }
    // The cells contain the quanta: y reaches 18.
    EXPECT_GE(static_cast<double>(gcd.lattice.extent), 18.0);
    EXPECT_EQ(gcd.lattice.origin, sixteenQuanta().origin);
}

// A cell is never smaller than its quanta, whichever way single precision rounds.
TEST(GcdLattice, hasCellsAtLeastAsLargeAsTheirQuanta) {
    for (const double quantum : {1.0, 0.9, 0.7, 0.3}) {
        Scene scene;
        addTriangle(scene, {0, 0, 0}, {16, 16, 0}, {0, 16, 16});
        const Lattice quanta = quantaOf(scene, quantum);
        for (const double plane : {3.0, 5.0, 6.0, 7.0, 9.0, 10.0, 11.0, 13.0}) {
            const GcdLattice gcd = makeGcdLattice(quanta, {{{0, plane, 2}, kLeaf, kLeaf}, 1});
            ASSERT_EQ(gcd.rounding.quantaPerCell.x, static_cast<std::uint32_t>(plane));
            // Both products are exact.
            EXPECT_LE(static_cast<double>(gcd.lattice.cellsPerUnit.x) * plane,
                      static_cast<double>(quanta.cellsPerUnit.x))
                << quantum << ' ' << plane;
        }
    }
}

// A plane that is rounded to a face of its node splits nothing and must not affect the divisor.
TEST(GcdLattice, leavesPlanesOutThatVanish) {
    const SplitPlan atTheBox{{{0, 0.3, 2}, kLeaf, {0, 15.8, 4}, kLeaf, kLeaf}, 2};
    const GcdLattice one = makeGcdLattice(sixteenQuanta(), atTheBox);
    EXPECT_EQ(one.lattice.resolution, glm::uvec3(1));
    EXPECT_EQ(one.plan.nodes.size(), 1u);
    EXPECT_EQ(one.plan.depth, 0u);
    const SplitPlan together{{{0, 8.1, 2}, kLeaf, {0, 8.4, 4}, kLeaf, {1, 7.9, 6}, kLeaf, kLeaf}, 3};
    const GcdLattice two = makeGcdLattice(sixteenQuanta(), together);
    EXPECT_EQ(two.lattice.resolution, glm::uvec3(2, 2, 1));
    EXPECT_EQ(two.plan.nodes.size(), 5u);
    EXPECT_EQ(two.plan.depth, 2u);
}

// Clusters of triangles fill some blocks of a 4 x 6 x 8 grid, so the first planes are the blocks' faces.
TEST(GcdLattice, findsTheRasterOfAScene) {
    Scene scene;
    for (const glm::vec3 block : {glm::vec3(0, 0, 0), glm::vec3(8, 12, 16), glm::vec3(20, 24, 0)}) {
        for (int i = 0; i < 200; ++i) {
            const float shift = 0.005f * static_cast<float>(i);
            addTriangle(scene, block + glm::vec3(shift, 0, 0), block + glm::vec3(4, 6, shift),
                        block + glm::vec3(4, shift, 8));
            addTriangle(scene, block + glm::vec3(0, shift, 8), block + glm::vec3(0, 6, shift),
                        block + glm::vec3(4, 0, shift));
        }
    }
    for (const double quantum : {1.0, 0.25}) {
        SCOPED_TRACE(quantum);
        AccelerationOptions options = withQuantum(quantum);
        options.treeDepth = 3;
        const AccelerationStructure structure = buildAccelerationStructure(scene, options);
        ASSERT_TRUE(structure.rounding);
        const glm::dvec3 perRaster = structure.unit / glm::dvec3(4, 6, 8);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(perRaster[axis], std::round(perRaster[axis])) << "axis " << axis;
        }
        EXPECT_LE(structure.lattice.cellCount, 6u * 5u * 3u);
        EXPECT_GT(structure.lattice.cellCount, 1u);
    }
}

double worldPlane(const Lattice& lattice, const PlannedNode& node) {
    const int axis = static_cast<int>(node.axis);
    return static_cast<double>(lattice.origin[axis]) +
           node.plane / static_cast<double>(lattice.cellsPerUnit[axis]);
}

TEST(GcdLattice, movesNoPlaneFartherThanItSays) {
    const Scene scene = triangleSoup(600, 3);
    for (const double quantum : {0.1, 0.01, 0.003}) {
        SCOPED_TRACE(quantum);
        const Lattice quanta = quantaOf(scene, quantum);
        const SplitPlan plan = planSplits(quanta, cornersIn(quanta, scene), 12);
        const GcdLattice gcd = makeGcdLattice(quanta, plan);
        std::size_t planes = 0;
        for (const PlannedNode& rounded : gcd.plan.nodes) {
            if (rounded.axis == kNoSplit) {
                continue;
            }
            ++planes;
            EXPECT_EQ(rounded.plane, std::round(rounded.plane));
            const double place = worldPlane(gcd.lattice, rounded);
            EXPECT_TRUE(std::ranges::any_of(plan.nodes,
                                            [&](const PlannedNode& node) {
                                                return node.axis == rounded.axis &&
                                                       std::abs(worldPlane(quanta, node) - place) <=
                                                           gcd.rounding.farthest;
                                            }))
                << "no planned plane near " << place;
        }
        EXPECT_GT(planes, 100u);
        EXPECT_LT(gcd.rounding.farthest, 0.5002 * quantum);
    }
}

TEST(GcdLattice, refusesAQuantumFinerThanTheMargin) {
    expectError(ErrorKind::invalidArgument,
                "a quantum of 1e-09 is finer than single precision; give at least", {"quantum"},
                [] { buildAccelerationStructure(unitCube(), withQuantum(1e-9)); });
}

TEST(GcdLattice, refusesTooManyCellsOnAnAxisWithTheirSize) {
    const Scene scene = triangleSoup(6000, 3);
    expectError(ErrorKind::outOfMemory, "a lattice has at most 1023 on an axis; choose a larger quantum",
                {"quantum", "treeDepth"},
                [&] { buildAccelerationStructure(scene, withQuantum(1.0 / 4000.0)); });
}

TEST(SplitPlan, doesNotDependOnThreads) {
    const Scene scene = triangleSoup(20000, 4);
    const Lattice quanta = quantaOf(scene, 0.01);
    const auto planOn = [&](const int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        return planSplits(quanta, cornersIn(quanta, scene), 20).nodes;
    };
    const std::vector<PlannedNode> one = planOn(1);
    const std::vector<PlannedNode> four = planOn(4);
    EXPECT_GT(one.size(), 10000u);
    EXPECT_TRUE(std::ranges::equal(one, four, [](const PlannedNode& a, const PlannedNode& b) {
        return a.axis == b.axis && a.plane == b.plane && a.above == b.above;
    }));
}

// Two triangles far apart: a plane on either side of the gap, or on both, with empty space between.
TEST(SplitPlan, cutsAtTheEndsOfTriangles) {
    Scene scene;
    addTriangle(scene, {0, 0, 0}, {1, 4, 0}, {0, 0, 4});
    addTriangle(scene, {9, 0, 0}, {10, 4, 0}, {9, 0, 4});
    const Lattice quanta = quantaOf(scene, 0.01);
    const SplitPlan plan = planSplits(quanta, cornersIn(quanta, scene), 2);
    const double tolerance = 4.0 * kReferenceMargin * 10.0;
    ASSERT_NE(plan.nodes[0].axis, kNoSplit);
    for (const PlannedNode& node : plan.nodes) {
        if (node.axis == 0) {
            const double x = worldPlane(quanta, node);
            EXPECT_TRUE(std::abs(x - 1.0) < tolerance || std::abs(x - 9.0) < tolerance) << x;
        }
    }
}

} // namespace
} // namespace metamarch::tests
