// SPDX-License-Identifier: MIT
// The lattice's number of cells, its position, and the scenes and options that it refuses.
#include "fixtures/expect_error.h"
#include "metamarch/accel/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamarch::tests {
namespace {

constexpr std::uint32_t kTriangles = 1000;

Bounds boxFromOrigin(const glm::vec3 size) { return {glm::vec3(0.0f), size}; }

AccelerationOptions withUnit(const glm::dvec3 unit) { return {unit, {}, {}}; }
AccelerationOptions withCells(const std::uint64_t cells) { return {{}, cells, {}}; }

glm::uvec3 resolutionOf(const Bounds& bounds, const AccelerationOptions& options) {
    return makeLattice(bounds, kTriangles, options).lattice.resolution;
}

TEST(LatticeResolution, isThePapers) {
    // The bunny, and the Viewpoint cow divided by 10.
    const Bounds bunny{{-0.09469f, 0.032987f, -0.061874f}, {0.06101f, 0.187321f, 0.0588f}};
    EXPECT_EQ(resolutionOf(bunny, withUnit(glm::dvec3(0.002))), glm::uvec3(78, 78, 61));
    const Bounds cow{{-0.4445835f, -0.3637036f, -0.1701405f}, {0.5998088f, 0.275972f, 0.1701405f}};
    EXPECT_EQ(resolutionOf(cow, withUnit(glm::dvec3(0.02))), glm::uvec3(53, 32, 18));
    EXPECT_EQ(makeLattice(cow, kTriangles, withUnit(glm::dvec3(0.02))).lattice.cellCount, 30528u);
}

TEST(LatticeResolution, ofExactMultiplesIsTheQuotient) {
    EXPECT_EQ(resolutionOf(boxFromOrigin({0.3f, 0.6f, 0.7f}), withUnit(glm::dvec3(0.1))),
              glm::uvec3(3, 6, 7));
    EXPECT_EQ(resolutionOf(boxFromOrigin({1.0f, 2.5f, 10.0f}), withUnit({0.25, 2.5, 0.01})),
              glm::uvec3(4, 1, 1000));
    EXPECT_EQ(resolutionOf(boxFromOrigin(glm::vec3(1023.0f)), withUnit({1.0, 1023.0, 341.0})),
              glm::uvec3(1023, 1, 3));
}

TEST(LatticeResolution, roundsUp) {
    EXPECT_EQ(resolutionOf(boxFromOrigin({1.001f, 0.999f, 0.5f}), withUnit(glm::dvec3(1.0))),
              glm::uvec3(2, 1, 1));
}

TEST(LatticeResolution, isOneOnAFlatAxis) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 size(1.0f);
        size[axis] = 0.0f;
        EXPECT_EQ(resolutionOf(boxFromOrigin(size), {})[axis], 1u);
        EXPECT_EQ(resolutionOf(boxFromOrigin(size), withUnit(glm::dvec3(0.1)))[axis], 1u);
        glm::vec3 needle(0.0f);
        needle[axis] = 1.0f;
        glm::uvec3 expected(1);
        expected[axis] = 10;
        EXPECT_EQ(resolutionOf(boxFromOrigin(needle), withUnit(glm::dvec3(0.1))), expected);
    }
}

TEST(LatticeResolution, isOneCellWithoutTriangles) {
    const Bounds none{glm::vec3(1.0f), glm::vec3(-1.0f)};
    for (const AccelerationOptions& options : {AccelerationOptions{}, withUnit(glm::dvec3(1e-4)),
                                               withCells(1000000), withCells(std::uint64_t{1} << 40)}) {
        EXPECT_EQ(makeLattice(none, 0, options).lattice.resolution, glm::uvec3(1));
    }
}

TEST(LatticeResolution, comesNearTheCellsAskedFor) {
    const glm::vec3 sizes[] = {{1, 1, 1},         {1, 0.5f, 0.1f}, {3, 3, 0.01f},     {1, 1, 0},
                               {1, 0.01f, 0.01f}, {1, 0, 0},       {1e-9f, 1e-9f, 0}, {1e9f, 1e7f, 1e8f}};
    for (const glm::vec3 size : sizes) {
        for (const std::uint64_t target :
             {1u, 2u, 1000u, 30528u, 371124u, 6000000u, 1u << 28u, 1000000000u}) {
            const Lattice lattice = makeLattice(boxFromOrigin(size), kTriangles, withCells(target)).lattice;
            const glm::uvec3 counts = lattice.resolution;
            EXPECT_EQ(lattice.cellCount, counts.x * counts.y * counts.z);
            EXPECT_LE(lattice.cellCount, target);
            const bool axisIsFull = std::max({counts.x, counts.y, counts.z}) == kMaxLatticeResolution;
            // One more cell on every axis that can be divided would be too many.
            std::uint64_t next = 1;
            for (int axis = 0; axis < 3; ++axis) {
                next *= counts[axis] + (size[axis] > 0.0f ? 1u : 0u);
            }
            EXPECT_TRUE(axisIsFull || next > target)
                << counts.x << " x " << counts.y << " x " << counts.z << " cells for " << target;
        }
    }
}

TEST(LatticeResolution, growsWithTheTriangles) {
    std::uint32_t before = 0;
    for (const std::uint32_t triangles : {1u, 10000u, 100000u, 1000000u}) {
        const Lattice lattice = makeLattice(boxFromOrigin(glm::vec3(1.0f)), triangles, {}).lattice;
        EXPECT_GT(lattice.cellCount, before);
        EXPECT_EQ(lattice.triangleCount, triangles);
        before = lattice.cellCount;
    }
    const Lattice most = makeLattice(boxFromOrigin(glm::vec3(1.0f)), 0xffffffffu, {}).lattice;
    EXPECT_LE(most.cellCount, kMostAutomaticCells);
}

// If triangles are small in a large box, each axis on its own gets cells as fine as the triangles need.
TEST(LatticeResolution, isFineWhereTrianglesAreSmall) {
    const auto resolutionFor = [](const glm::vec3 size, const double typicalEdge) {
        return makeLattice(boxFromOrigin(size), kTriangles, {}, typicalEdge).lattice.resolution;
    };
    EXPECT_EQ(resolutionFor(glm::vec3(1.0f), 1.0), resolutionFor(glm::vec3(1.0f), 0.0));
    EXPECT_EQ(resolutionFor(glm::vec3(1.0f), 1.0 / 600), glm::uvec3(400));
    EXPECT_EQ(resolutionFor({1.0f, 0.25f, 1.0f}, 1.0 / 3000), glm::uvec3(1023, 500, 1023));
    EXPECT_EQ(resolutionFor({1.0f, 0x1p-12f, 1.0f}, 1e-9), glm::uvec3(1023, 16, 1023)); // four margins
}

// Geometry keeps a distance from the faces of the lattice, so that rounding cannot carry a hit out of it.
void expectPadding(const Bounds& bounds, const AccelerationOptions& options) {
    const Lattice lattice = makeLattice(bounds, kTriangles, options).lattice;
    SCOPED_TRACE(testing::Message() << "origin " << lattice.origin.x << " " << lattice.origin.y << " "
                                    << lattice.origin.z << ", extent " << lattice.extent);
    // The scale is rounded to single precision, which can cost a few half-ulps of the lattice.
    constexpr double kRounding = 2.0 * 0x1p-24;
    const glm::dvec3 padding =
        (kBoxPadding - kRounding) * static_cast<double>(lattice.extent) * glm::dvec3(lattice.cellsPerUnit);
    const glm::dvec3 lo = toLattice(lattice, bounds.lo);
    const glm::dvec3 hi = toLattice(lattice, bounds.hi);
    double longest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(lo[axis], padding[axis]);
        EXPECT_LE(hi[axis], lattice.resolution[axis] - padding[axis]);
        longest = std::max(longest, lattice.resolution[axis] / double{lattice.cellsPerUnit[axis]});
    }
    EXPECT_NEAR(lattice.extent, longest, longest * 0x1p-22);
}

TEST(LatticePadding, keepsGeometryInside) {
    const glm::vec3 sizes[] = {{1, 1, 1}, {1, 0.5f, 0.001f}, {1, 0, 1}, {0, 2, 0}, {0.3f, 0.6f, 0.7f}};
    for (const glm::vec3 size : sizes) {
        for (const float scale : {1e-9f, 1.0f, 1e9f}) {
            for (const float distance : {0.0f, 1.0f, 100.0f, 1e5f}) {
                const glm::vec3 lo = scale * distance * glm::vec3(1.0f, -0.1f, 0.5f);
                const Bounds bounds{lo, lo + scale * size};
                expectPadding(bounds, {});
                expectPadding(bounds, withUnit(glm::dvec3(0.1 * static_cast<double>(scale))));
                expectPadding(bounds, withUnit(glm::dvec3(5.0 * static_cast<double>(scale))));
            }
        }
    }
}

TEST(LatticeRefusal, tooManyCellsOnAnAxis) {
    const Bounds bounds = boxFromOrigin({1.0f, 0.5f, 0.25f});
    const AccelerationOptions options = withUnit(glm::dvec3(0.0005));
    expectError(ErrorKind::outOfMemory, "2000 x 1000 x 500",
                [&] { makeLattice(bounds, kTriangles, options); });
    expectError(ErrorKind::outOfMemory, "choose a unit of at least",
                [&] { makeLattice(bounds, kTriangles, options); });
}

TEST(LatticeRefusal, namesAUnitThatIsTaken) {
    for (float size = 1.0f; size < 1000.0f; size *= 1.37f) {
        const Bounds bounds = boxFromOrigin({size, 0.0f, 0.0f});
        const std::string line = lineOfError(ErrorKind::outOfMemory, [&] {
            makeLattice(bounds, kTriangles, withUnit(glm::dvec3(size / 5000.0)));
        });
        const double unit = std::stod(line.substr(line.find_last_of(' ')));
        EXPECT_GE(resolutionOf(bounds, withUnit(glm::dvec3(unit))).x, kMaxLatticeResolution - 1) << line;
    }
}

TEST(LatticeRefusal, moreCellsThanThereMayBe) {
    const Bounds cube = boxFromOrigin(glm::vec3(1.0f));
    for (const std::uint64_t cells : {std::uint64_t{1070599168}, ~std::uint64_t{0}}) {
        expectError(ErrorKind::outOfMemory, "choose fewer than 1070599168", {"cells"},
                    [&] { makeLattice(cube, kTriangles, withCells(cells)); });
    }
}

TEST(LatticeRefusal, sceneOutsideSinglePrecision) {
    for (const float size : {0.0f, 1e-11f, 1e11f, 3e38f}) {
        expectError(ErrorKind::inputRefused, "; scale it", {"scale"},
                    [&] { makeLattice(boxFromOrigin(glm::vec3(size)), kTriangles, {}); });
    }
    EXPECT_NO_THROW(makeLattice(boxFromOrigin(glm::vec3(1.1e-10f)), kTriangles, {}));
    EXPECT_NO_THROW(makeLattice(boxFromOrigin(glm::vec3(1e10f)), kTriangles, {}));
}

TEST(Lattice, mapsItsCellsBackToTheWorld) {
    const Bounds bounds{{-3.0f, 10.0f, 0.25f}, {5.0f, 11.0f, 0.75f}};
    const Lattice lattice = makeLattice(bounds, kTriangles, withCells(5000)).lattice;
    for (const glm::vec3 position : {bounds.lo, bounds.hi, glm::vec3(1.0f, 10.5f, 0.3f)}) {
        const glm::dvec3 there = toWorld(lattice, toLattice(lattice, position));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(there[axis], position[axis], 1e-12);
        }
    }
    const glm::ivec3 resolution(lattice.resolution);
    const Bounds whole = worldBox(lattice, {glm::ivec3(0), resolution});
    const Bounds cell = worldBox(lattice, {resolution - 1, resolution});
    EXPECT_EQ(whole.lo, lattice.origin);
    EXPECT_EQ(cell.hi, whole.hi);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LT(whole.lo[axis], bounds.lo[axis]);
        EXPECT_GT(whole.hi[axis], bounds.hi[axis]);
        EXPECT_NEAR(cell.hi[axis] - cell.lo[axis], 1.0f / lattice.cellsPerUnit[axis], 2e-6f);
    }
}

} // namespace
} // namespace metamarch::tests
