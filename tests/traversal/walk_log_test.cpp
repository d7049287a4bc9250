// SPDX-License-Identifier: MIT
// The recorded walk has the visits and the hit of the stack traversal, and its stack holds what is visited
// later.
#include "fixtures/ray_sets.h"
#include "fixtures/shapes.h"
#include "metamarch/reference/walk_log.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>

namespace metamarch::tests {
namespace {

constexpr std::uint32_t kRays = 5000;

TEST(WalkLogs, haveTheVisitsTestsAndHitOfTheTraversal) {
    const Scene scene = triangleSoup(2000, 4);
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    std::size_t deepest = 0;
    for (const RayQuery& query : trickyRays(scene, structure, kRays, 21)) {
        SCOPED_TRACE(describe(query));
        const Ray ray = makeRay(structure.lattice, query.origin, query.tMin, query.dir, query.tMax);
        const TraceResult expected = traceKdStack(structure, ray, HitQuery::closest);
        const WalkLog log = logWalk(structure, ray);
        using Words = std::array<std::uint32_t, sizeof(TraceResult) / sizeof(std::uint32_t)>;
        ASSERT_EQ(std::bit_cast<Words>(log.result), std::bit_cast<Words>(expected));
        ASSERT_EQ(log.visits.size(), expected.steps);
        std::size_t depthOfStack = 0;
        for (std::size_t i = 0; i < log.visits.size(); ++i) {
            const WalkVisit& visit = log.visits[i];
            ASSERT_EQ(visit.parent == WalkVisit::kNone, i == 0);
            if (i == 0) {
                ASSERT_EQ(visit.nodeId, 0u);
                continue;
            }
            const WalkVisit& before = log.visits[i - 1];
            ASSERT_EQ(visit.depth, log.visits[visit.parent].depth + 1);
            // Below an inner node comes one of its children; behind a leaf comes the top of the stack.
            if (before.isLeaf) {
                ASSERT_FALSE(before.stack.empty());
                ASSERT_EQ(visit.nodeId, before.stack.back());
                ASSERT_GE(visit.tNear, before.tNear);
            } else {
                ASSERT_EQ(visit.parent, i - 1);
            }
            ASSERT_GE(visit.tests, before.tests);
            depthOfStack = std::max(depthOfStack, visit.stack.size());
        }
        ASSERT_TRUE(log.visits.empty() || log.visits.back().tests == expected.tests);
        deepest = std::max(deepest, depthOfStack);
    }
    EXPECT_GT(deepest, 2u);
}

} // namespace
} // namespace metamarch::tests
