// SPDX-License-Identifier: MIT
#include "metamarch/shared/false_color.h"
#include "metamarch/viewer/heat_range.h"

#include <gtest/gtest.h>

#include <vector>

namespace metamarch::viewer {
namespace {

// A picture with the counts 0 to 100, as the kernel colours them.
std::vector<std::uint32_t> picture(const float heatMax) {
    std::vector<std::uint32_t> pixels;
    pixels.reserve(1'010);
    for (int count = 0; count <= 100; ++count) {
        pixels.insert(pixels.end(), 10, packedPixel(heatColor(static_cast<float>(count) / heatMax)));
    }
    return pixels;
}

TEST(HeatRange, findsTheHottestPart) {
    EXPECT_NEAR(hottestPart(picture(200.0f)), 0.5f, 0.01f);
    EXPECT_NEAR(hottestPart(picture(400.0f)), 0.25f, 0.01f);
    EXPECT_EQ(hottestPart(picture(50.0f)), 1.0f);
    std::vector<std::uint32_t> few = picture(400.0f);
    std::fill_n(few.begin(), 4, packedPixel(heatColor(1.0f))); // fewer than 0.5 %
    EXPECT_NEAR(hottestPart(few), 0.25f, 0.01f);
}

TEST(HeatRange, comesToRestWithTheUpperHalfInUse) {
    for (const float first : {1.0f, 32.0f, 100.0f, 150.0f, 4000.0f}) {
        float heat = first;
        for (int turn = 0; turn < 12; ++turn) {
            heat = fittingHeat(picture(heat), heat);
        }
        EXPECT_EQ(fittingHeat(picture(heat), heat), heat) << first;
        EXPECT_GT(heat, 100.0f) << first;
        EXPECT_LE(heat, 202.0f) << first;
    }
    EXPECT_EQ(fittingHeat(std::vector(100, packedPixel(heatColor(0.0f))), 32.0f), 1.0f);
}

} // namespace
} // namespace metamarch::viewer
