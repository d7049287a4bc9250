#include "image/tone_mapping.h"

#include <gtest/gtest.h>

#include <limits>

namespace metamarch {
namespace {

// By hand from IEC 61966-2-1: 255 * (1.055 * x^(1/2.4) - 0.055), below 0.0031308 255 * 12.92 * x.
TEST(ToneMapping, FollowsTheSrgbCurve) {
    EXPECT_EQ(toSrgb8(0.0f), 0);
    EXPECT_EQ(toSrgb8(0.001f), 3);   // 3.29, the straight part
    EXPECT_EQ(toSrgb8(0.0031f), 10); // 10.21
    EXPECT_EQ(toSrgb8(0.18f), 118);  // 117.6, middle grey
    EXPECT_EQ(toSrgb8(0.5f), 188);   // 187.5
    EXPECT_EQ(toSrgb8(1.0f), 255);
}

TEST(ToneMapping, ClampsWhatAScreenCannotShow) {
    EXPECT_EQ(toSrgb8(-1.0f), 0);
    EXPECT_EQ(toSrgb8(17.0f), 255);
    EXPECT_EQ(toSrgb8(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(toSrgb8(-std::numeric_limits<float>::infinity()), 0);
    EXPECT_EQ(toSrgb8(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(toLinear8(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(toLinear8(2.0f), 255);
}

TEST(ToneMapping, NeverFallsAsLightGrows) {
    for (int step = 1; step <= 100000; ++step)
        ASSERT_LE(toSrgb8(static_cast<float>(step - 1) * 1e-5f), toSrgb8(static_cast<float>(step) * 1e-5f));
}

TEST(ToneMapping, AlphaIsLinear) {
    EXPECT_EQ(toLinear8(0.25f), 64); // 63.75
    EXPECT_EQ(toLinear8(0.5f), 128); // 127.5
}

} // namespace
} // namespace metamarch
