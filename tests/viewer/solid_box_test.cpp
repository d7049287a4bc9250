// SPDX-License-Identifier: MIT
#include "loaded_cube.h"
#include "metamarch/viewer/solid_box.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamarch::viewer {
namespace {

std::size_t seenCorners(const SolidBox& box) {
    std::size_t seen = 0;
    for (const SolidPart& part : box.parts) {
        seen += static_cast<std::size_t>(std::ranges::count(part.corners, true, &SolidPoint::isSeen));
    }
    return seen;
}

TEST(SolidBox, isSeenBeforeASurfaceAndHiddenBehindIt) {
    const LoadedScene scene = loadedCube();
    const SolidBox before = solidBox(scene, beforeCube(), {{0.4f, 0.4f, 1.5f}, {0.6f, 0.6f, 1.6f}});
    ASSERT_FALSE(before.parts.empty());
    EXPECT_EQ(seenCorners(before), 4 * before.parts.size());
    EXPECT_TRUE(std::ranges::all_of(before.edges, &SolidEdge::isSeen));

    const SolidBox behind = solidBox(scene, beforeCube(), {{0.4f, 0.4f, -2.0f}, {0.6f, 0.6f, -1.0f}});
    EXPECT_TRUE(behind.parts.empty());
    EXPECT_FALSE(behind.edges.empty());
    EXPECT_TRUE(std::ranges::none_of(behind.edges, &SolidEdge::isSeen));
}

TEST(SolidBox, isCutWhereASurfaceHidesAPart) {
    const SolidBox half = solidBox(loadedCube(), beforeCube(), {{-1.0f, 0.4f, -2.0f}, {0.5f, 0.6f, -1.0f}});
    ASSERT_FALSE(half.parts.empty());
    EXPECT_LT(seenCorners(half), 4 * half.parts.size());
    // The cube's face begins at x = 0, which is 50 / (3 tan 0.4) pixels left of the middle.
    for (const SolidPart& part : half.parts) {
        for (const SolidPoint& corner : part.corners) {
            EXPECT_EQ(corner.isSeen, corner.place.x < 100.0f - 50.0f / (3.0f * std::tan(0.4f)));
        }
    }
}

// A face in the plane of a surface is seen.
TEST(SolidBox, isNotHiddenByASurfaceInItsFace) {
    const SolidBox box = solidBox(loadedCube(), beforeCube(), {{0, 0, 0}, {1, 1, 1}});
    EXPECT_FALSE(box.parts.empty());
    EXPECT_EQ(seenCorners(box), 4 * box.parts.size());
}

} // namespace
} // namespace metamarch::viewer
