// SPDX-License-Identifier: MIT
#include "loaded_cube.h"
#include "metamarch/viewer/pixel_readout.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamarch::viewer {
namespace {

bool has(const std::vector<std::string>& lines, const std::string& line) {
    return std::ranges::find(lines, line) != lines.end();
}

TEST(PixelReadout, givesTheMeansOfTheFilm) {
    EXPECT_EQ(channelLines(emptyPixel()), std::vector<std::string>{"no samples yet"});
    FirstHit first = missFirst();
    first.normal = glm::vec3(0.0f, 1.0f, 0.0f);
    first.depth = 2.5f;
    first.triangleId = 7;
    const std::vector<std::string> lines = channelLines(onlySample(glm::vec3(0.25f, 0.5f, 1.0f), first));
    EXPECT_TRUE(has(lines, "R G B        0.25 0.5 1"));
    EXPECT_TRUE(has(lines, "N            0 1 0"));
    EXPECT_TRUE(has(lines, "Z            2.5"));
    EXPECT_TRUE(has(lines, "id.triangle  7"));
}

TEST(PixelReadout, saysWhatTheRayMeets) {
    const LoadedScene scene = loadedCube();
    const std::vector<std::string> lines = hitLines(scene, beforeCube(), {100.0f, 100.0f});
    EXPECT_TRUE(lines.front().ends_with("of mesh 0 cube")) << lines.front();
    EXPECT_TRUE(has(lines, "point        0.5 0.5 1"));
    EXPECT_TRUE(has(lines, "distance     3"));
    EXPECT_TRUE(lines.back().starts_with("cell         (")) << lines.back();
    EXPECT_EQ(hitLines(scene, beforeCube(), {1.0f, 1.0f}), std::vector<std::string>{"the ray hits nothing"});
}

} // namespace
} // namespace metamarch::viewer
