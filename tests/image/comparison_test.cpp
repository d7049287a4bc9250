// SPDX-License-Identifier: MIT
#include "metamarch/image/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace metamarch {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// One row of pixels, one channel.
Image row(std::vector<float> values, const std::string& channel = "R") {
    Image image(static_cast<int>(values.size()), 1, {channel});
    image.pixels = std::move(values);
    return image;
}

double maxDifferenceOf(float a, float b) {
    return compareImages(row({a}), row({b})).channels.at(0).maxDifference;
}

TEST(Comparison, ByHand) {
    // Differences 0, 1, -3, 0.5 against 1, 1, 2, 0.
    const Comparison result = compareImages(row({1, 2, -1, 0.5f}), row({1, 1, 2, 0}), {0.5, 50.0});
    const ChannelComparison& channel = result.channels.at(0);
    EXPECT_DOUBLE_EQ(channel.rmse, std::sqrt((1.0 + 9.0 + 0.25) / 4.0));
    EXPECT_DOUBLE_EQ(channel.relativeMse, (1.0 / 1.01 + 9.0 / 4.01 + 0.25 / 0.01) / 4.0);
    EXPECT_DOUBLE_EQ(channel.meanDifference, -1.5 / 4.0);
    EXPECT_DOUBLE_EQ(channel.maxDifference, 3.0);
    EXPECT_EQ(channel.worstX, 2);
    EXPECT_EQ(channel.worstY, 0);
    EXPECT_EQ(channel.worstA, -1.0f);
    EXPECT_EQ(channel.worstB, 2.0f);
    EXPECT_EQ(channel.failingPixels, 2u); // a difference of exactly the bound passes
    EXPECT_DOUBLE_EQ(channel.failingPercent, 50.0);
    EXPECT_TRUE(result.passed);
    EXPECT_FALSE(compareImages(row({1, 2, -1, 0.5f}), row({1, 1, 2, 0}), {0.5, 49.9}).passed);
}

TEST(Comparison, NamesTheWorstPixelFromTheTopLeft) {
    Image a(3, 2, {"R", "G"});
    Image b = a;
    b.at(2, 1, 1) = 5.0f;
    const Comparison result = compareImages(a, b);
    EXPECT_EQ(result.channels.at(0).maxDifference, 0.0);
    EXPECT_EQ(result.channels.at(1).worstX, 2);
    EXPECT_EQ(result.channels.at(1).worstY, 1);
}

TEST(Comparison, InfinitiesAndNansNeitherCancelNorVanish) {
    EXPECT_EQ(maxDifferenceOf(kInf, kInf), 0.0);
    EXPECT_EQ(maxDifferenceOf(-kInf, -kInf), 0.0);
    EXPECT_EQ(maxDifferenceOf(kNan, kNan), 0.0);
    EXPECT_EQ(maxDifferenceOf(-0.0f, 0.0f), 0.0);
    EXPECT_EQ(maxDifferenceOf(kInf, -kInf), kInf);
    EXPECT_EQ(maxDifferenceOf(kInf, 1.0f), kInf);
    EXPECT_EQ(maxDifferenceOf(1.0f, kInf), kInf);
    EXPECT_EQ(maxDifferenceOf(kNan, 1.0f), kInf);
    EXPECT_EQ(maxDifferenceOf(1.0f, kNan), kInf);
    EXPECT_EQ(maxDifferenceOf(kNan, kInf), kInf);
}

TEST(Comparison, AnInfinityShowsInEveryNumber) {
    const Comparison result = compareImages(row({1, kInf}), row({1, 1}), {1e30, 0.0});
    EXPECT_EQ(result.channels.at(0).rmse, kInf);
    EXPECT_EQ(result.channels.at(0).relativeMse, kInf);
    EXPECT_EQ(result.channels.at(0).meanDifference, kInf);
    EXPECT_EQ(result.failingPixels, 1u);
    EXPECT_FALSE(result.passed);
    EXPECT_TRUE(std::isnan(compareImages(row({kInf, 1}), row({1, kInf})).channels.at(0).meanDifference));
}

TEST(Comparison, EqualInfinitiesLeaveFiniteMeans) {
    const Comparison result = compareImages(row({kInf, 3}), row({kInf, 1}));
    EXPECT_DOUBLE_EQ(result.channels.at(0).rmse, std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(result.channels.at(0).relativeMse, 4.0 / 1.01 / 2.0);
}

TEST(Comparison, DoesNotOverflowOnTheLargestFloats) {
    const float largest = std::numeric_limits<float>::max();
    EXPECT_DOUBLE_EQ(maxDifferenceOf(largest, -largest), 2.0 * static_cast<double>(largest));
}

TEST(Comparison, AFailingPixelCountsOnce) {
    Image a(2, 1, {"R", "G"});
    Image b = a;
    b.at(0, 0, 0) = 1.0f;
    b.at(0, 0, 1) = 1.0f;
    EXPECT_EQ(compareImages(a, b).failingPixels, 1u);
    EXPECT_DOUBLE_EQ(compareImages(a, b).failingPercent, 50.0);
}

TEST(Comparison, MatchesChannelsByName) {
    Image a(1, 1, {"R", "N.X"});
    a.pixels = {1, 2};
    Image b(1, 1, {"N.X", "R"});
    b.pixels = {2, 1};
    EXPECT_TRUE(compareImages(a, b).passed);
}

TEST(Comparison, AChannelInOnlyOnePictureFails) {
    Image a(1, 1, {"R", "Z"});
    Image b(1, 1, {"R", "t"});
    const Comparison result = compareImages(a, b, {kInf, 100.0});
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.mismatches, (std::vector<std::string>{"channel Z is only in the first picture",
                                                           "channel t is only in the second picture"}));
    EXPECT_EQ(result.channels.size(), 1u);
}

TEST(Comparison, CountersAreReportedButNeverJudged) {
    Image a(1, 1, {"R", "steps", "tests"});
    Image b(1, 1, {"R", "steps"});
    a.pixels = {1, 7, 9};
    b.pixels = {1, 3};
    const Comparison result = compareImages(a, b);
    EXPECT_TRUE(result.passed);
    EXPECT_EQ(result.failingPixels, 0u);
    EXPECT_EQ(result.channels.at(1).maxDifference, 4.0);
    EXPECT_FALSE(result.channels.at(1).judged);
    EXPECT_FALSE(compareImages(row({1}, "steps"), row({1}, "steps")).passed) << "nothing was judged";
}

TEST(Comparison, OtherSizesFail) {
    const Comparison result = compareImages(Image(2, 3, {"R"}), Image(3, 2, {"R"}), {kInf, 100.0});
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.mismatches, (std::vector<std::string>{"the sizes are 2x3 and 3x2"}));
}

TEST(Comparison, DifferenceImageHoldsAbsoluteDifferencesOfCommonChannels) {
    Image a(2, 1, {"R", "Z"});
    a.pixels = {1, kInf, -4, kInf};
    Image b(2, 1, {"Z", "R", "t"});
    b.pixels = {kInf, 3, 0, 5, -5, 0};
    const Image difference = differenceImage(a, b);
    EXPECT_EQ(difference.channels, (std::vector<std::string>{"R", "Z"}));
    EXPECT_EQ(difference.pixels, (std::vector<float>{2, 0, 1, kInf}));
}

} // namespace
} // namespace metamarch
