// SPDX-License-Identifier: MIT
#include "fixtures/shapes.h"
#include "metamarch/viewer/march_story.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamarch::viewer {
namespace {

constexpr Hit kNothing{100.0f, kNoTriangle};

// A march through three leaves, with a hit in the last one.
MarchLog threeSteps() {
    MarchLog log;
    log.steps = {
        {{1, 2, 3}, 7, {{0, 0, 0}, {2, 3, 4}}, 0, 0, 0.0f, 1.0f, kNothing, false},
        {{2, 2, 3}, 8, {{2, 2, 3}, {3, 3, 4}}, 1, 0, 1.0f, 2.0f, kNothing, false},
        {{3, 2, 3}, 9, {{3, 2, 3}, {5, 3, 4}}, 3, 2, 2.0f, 4.0f, {3.5f, 42}, true},
    };
    return log;
}

TEST(MarchStory, tellsWhatTheTableSaysAndWhereTheRayGoes) {
    const MarchLog log = threeSteps();
    EXPECT_EQ(sentenceOf(log, 0),
              "The ray is in cell (1, 2, 3). The table says: leaf 7. It is empty. We leave the box of "
              "2 x 3 x 4 cells, and jump to cell (2, 2, 3).");
    EXPECT_EQ(sentenceOf(log, 1),
              "The ray is in cell (2, 2, 3). The table says: leaf 8. It holds 1 triangle; the ray meets "
              "none of their boxes. We leave the box of 1 x 1 x 1 cells, and jump to cell (3, 2, 3).");
    EXPECT_EQ(sentenceOf(log, 2),
              "The ray is in cell (3, 2, 3). The table says: leaf 9. It holds 3 triangles. Triangle 42 is "
              "hit at 3.5, before the exit: nothing nearer can come. The march ends.");
}

TEST(MarchStory, tellsOfHitsBehindTheExitAndOfTheLatticesEnd) {
    MarchLog log = threeSteps();
    log.steps[1].tests = 1;
    EXPECT_NE(sentenceOf(log, 1).find("It holds 1 triangle; 1 tested, none is hit before the exit."),
              std::string::npos);
    log.steps[1].best = {3.5f, 42};
    EXPECT_NE(sentenceOf(log, 1).find("triangle 42 is hit, but behind the exit"), std::string::npos);
    log.steps.pop_back();
    log.steps.back().best = kNothing;
    EXPECT_TRUE(sentenceOf(log, 1).ends_with("Behind the exit the lattice ends: the ray hits nothing."));
}

// Both logs are of one ray: its counters go up together, and end with all visits.
TEST(MarchStory, countsTheVisitsUpToAStep) {
    const Scene scene = tests::triangleSoup(500, 6);
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const glm::vec3 origin(4.0f, 2.5f, -3.0f);
    const Ray ray =
        makeRay(structure.lattice, origin, 0.0f, glm::vec3(0.45f, 0.5f, 0.55f) - origin, kFarthest);
    const MarchLog march = logMarch(structure, ray);
    const WalkLog walk = logWalk(structure, ray);
    ASSERT_GT(march.steps.size(), 2u);
    std::size_t before = 0;
    for (std::size_t i = 0; i < march.steps.size(); ++i) {
        const std::size_t visits = visitsUpTo(walk, march, i);
        EXPECT_GE(visits, before);
        before = visits;
    }
    EXPECT_GT(visitsUpTo(walk, march, 0), 0u);
    EXPECT_EQ(before, walk.visits.size());
    EXPECT_TRUE(sentenceOf(walk, walk.visits.size() - 1).ends_with("The walk ends."));
    const auto leaf = std::ranges::find(walk.visits, true, &WalkVisit::isLeaf);
    EXPECT_TRUE(
        sentenceOf(walk, static_cast<std::size_t>(leaf - walk.visits.begin())).starts_with("A leaf with "));
}

} // namespace
} // namespace metamarch::viewer
