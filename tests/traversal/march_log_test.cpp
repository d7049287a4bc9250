// SPDX-License-Identifier: MIT
// The recorded march has the steps and the hit of the march, and adjacent boxes.
#include "fixtures/ray_sets.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/structure_set.h"
#include "metamarch/reference/march_log.h"
#include "metamarch/shared/march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace metamarch::tests {
namespace {

constexpr std::uint32_t kRays = 20000;

class MarchLogs : public testing::TestWithParam<bool> {
  protected:
    static AccelerationOptions options() { return {{}, 4096u, {}, TableMethod::unit, {}, GetParam()}; }

    Ray rayOf(const RayQuery& query) const {
        return makeRay(structure.lattice, query.origin, query.tMin, query.dir, query.tMax);
    }

    const Scene scene = triangleSoup(2000, 4);
    const AccelerationStructure structure = buildAccelerationStructure(scene, options());
    const std::vector<RayQuery> rays = trickyRays(scene, structure, kRays, 21);
};

TEST_P(MarchLogs, haveTheStepsTestsAndHitOfTheMarch) {
    std::size_t hits = 0;
    std::size_t misses = 0;
    for (const RayQuery& query : rays) {
        SCOPED_TRACE(describe(query));
        const Ray ray = rayOf(query);
        for (const HitQuery wanted : {HitQuery::closest, HitQuery::any}) {
            const TraceResult expected = traceMetaTable(structure, ray, wanted);
            const MarchLog log = logMarch(structure, ray, wanted);
            using Words = std::array<std::uint32_t, sizeof(TraceResult) / sizeof(std::uint32_t)>;
            ASSERT_EQ(std::bit_cast<Words>(log.result), std::bit_cast<Words>(expected));
            ASSERT_EQ(log.steps.size(), expected.steps);
            std::uint32_t tests = 0;
            for (const MarchStep& step : log.steps) {
                ASSERT_LE(step.tests, step.triangleCount);
                tests += step.tests;
            }
            ASSERT_EQ(tests, expected.tests);
            if (log.steps.empty()) {
                continue;
            }
            const MarchStep& last = log.steps.back();
            const bool isHit = expected.hit.triangleId != kNoTriangle;
            (isHit ? hits : misses) += 1;
            ASSERT_EQ(last.best.triangleId, expected.hit.triangleId);
            ASSERT_EQ(last.best.t, ray.shift + expected.hit.t);
            ASSERT_EQ(last.isFinal, isHit);
        }
    }
    EXPECT_GT(hits, kRays / 10);
    EXPECT_GT(misses, kRays / 10);
}

TEST_P(MarchLogs, leadFromBoxToBox) {
    for (const RayQuery& query : rays) {
        SCOPED_TRACE(describe(query));
        const Ray ray = rayOf(query);
        const std::vector<MarchStep> steps = logMarch(structure, ray).steps;
        float tNear = ray.shift + ray.tNear;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const MarchStep& step = steps[i];
            const CellBox& box = step.exitBox;
            ASSERT_EQ(step.leafId, structure.table.leafAt(step.cell));
            ASSERT_EQ(step.cell, clamp(step.cell, box.lo, box.hi - 1));
            ASSERT_EQ(step.triangleCount, structure.table.leaves[step.leafId].triangleCount);
            ASSERT_EQ(step.tNear, tNear);
            const BoxExit exit = leaveBox(ray, box.lo, box.hi, step.cell);
            ASSERT_EQ(step.tFar, ray.shift + exit.t);
            if (i + 1 < steps.size()) {
                ASSERT_EQ(steps[i + 1].cell, exit.cell);
                ASSERT_LE(steps[i + 1].best.t, step.best.t);
                ASSERT_FALSE(step.isFinal);
            } else if (!step.isFinal) {
                const bool isAtEnd = step.best.t <= step.tFar; // of a limited ray
                ASSERT_TRUE(isAtEnd || !isInLattice(exit.cell, structure.lattice.resolution));
            }
            tNear = step.tFar;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(ExitBoxes, MarchLogs, testing::Bool(), [](const auto& instance) {
    return std::string(instance.param ? "grown" : "leaves_own");
});

// The recorded crossings begin and end on the faces of their boxes, even for a distant origin and for a
// direction that does not have unit length.
TEST(MarchLogs, countTheirDistancesFromTheOriginGiven) {
    const Scene scene = triangleSoup(500, 6);
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const glm::vec3 origin(40.0f, 25.0f, -30.0f);
    const glm::vec3 dir = 0.125f * (glm::vec3(0.45f, 0.5f, 0.55f) - origin);
    const Ray ray = makeRay(structure.lattice, origin, 0.0f, dir, kFarthest);
    ASSERT_GT(ray.shift, 1.0f);
    const MarchLog log = logMarch(structure, ray);
    ASSERT_GT(log.steps.size(), 2u);
    for (const MarchStep& step : log.steps) {
        const Bounds box = worldBox(structure.lattice, step.exitBox);
        const glm::dvec3 exit = glm::dvec3(origin) + glm::dvec3(dir) * static_cast<double>(step.tFar);
        constexpr double kNear = 1e-4;
        double nearest = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GT(exit[axis], box.lo[axis] - kNear);
            EXPECT_LT(exit[axis], box.hi[axis] + kNear);
            nearest =
                std::min({nearest, std::abs(exit[axis] - box.lo[axis]), std::abs(exit[axis] - box.hi[axis])});
        }
        EXPECT_LT(nearest, kNear);
        EXPECT_LE(step.tNear, step.tFar);
    }
}

TEST(MarchLogs, areEmptyWhereTheRayMissesTheLattice) {
    const Scene scene = unitCube();
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const Ray ray = makeRay(structure.lattice, {5, 5, 5}, 0.0f, {1, 0, 0}, kFarthest);
    const MarchLog log = logMarch(structure, ray);
    EXPECT_TRUE(log.steps.empty());
    EXPECT_EQ(log.result.hit.triangleId, kNoTriangle);
}

} // namespace
} // namespace metamarch::tests
