// SPDX-License-Identifier: MIT
// The colours of false_color.h: their documented values and order.
#include "metamarch/shared/false_color.h"
#include "metamarch/shared/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace metamarch {
namespace {

float part(const std::uint32_t pixel, const unsigned channel) {
    return static_cast<float>((pixel >> (8 * channel)) & 255u) / 255.0f;
}

// Returns the luminance of a packed pixel.
float luminanceOf(const std::uint32_t pixel) {
    return luminance(srgbToLinear(vec3(part(pixel, 0), part(pixel, 1), part(pixel, 2))));
}

TEST(PackedPixel, hasRedInTheLowestByte) {
    EXPECT_EQ(packedPixel(vec3(1.0f, 0.0f, 0.0f)), 0xff0000ffu);
    EXPECT_EQ(packedPixel(vec3(0.0f, 1.0f, 0.0f)), 0xff00ff00u);
    EXPECT_EQ(packedPixel(vec3(0.0f, 0.0f, 1.0f)), 0xffff0000u);
}

TEST(PackedPixel, roundsAndClamps) {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        EXPECT_EQ(toLinear8((static_cast<float>(byte) + 0.4f) / 255.0f), byte);
        EXPECT_EQ(toLinear8((static_cast<float>(byte) - 0.4f) / 255.0f), byte);
    }
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(packedPixel(vec3(-1.0f, 2.0f, -0.0f)), 0xff00ff00u);
    EXPECT_EQ(packedPixel(vec3(std::numeric_limits<float>::quiet_NaN(), infinity, -infinity)), 0xff00ff00u);
    EXPECT_EQ(packedLinear(vec3(infinity, -infinity, 1e30f)), 0xffff00ffu);
}

TEST(SrgbCoded, isIec61966) {
    for (int i = 0; i <= 100000; ++i) {
        const double linear = i * 1e-5;
        const double exact =
            linear > 0.0031308 ? 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055 : 12.92 * linear;
        ASSERT_NEAR(srgbCoded(static_cast<float>(linear)), exact, 2e-6) << linear;
    }
}

// Values of Matplotlib's table; the polynomial is within 0.04 of them.
TEST(HeatColor, isInferno) {
    const struct {
        float at;
        vec3 color;
    } kEntries[] = {
        {0.0f, {0.001462f, 0.000466f, 0.013866f}},
        {64.0f / 255.0f, {0.341500f, 0.062325f, 0.429425f}},
        {128.0f / 255.0f, {0.735683f, 0.215906f, 0.330245f}},
        {191.0f / 255.0f, {0.978422f, 0.557937f, 0.034931f}},
        {1.0f, {0.988362f, 0.998364f, 0.644924f}},
    };
    for (const auto& entry : kEntries) {
        const vec3 difference = abs(heatColor(entry.at) - entry.color);
        EXPECT_LT(largest(difference), 0.04f) << entry.at;
    }
}

TEST(HeatColor, growsLighterAndEndsAtTheHottest) {
    float before = -1.0f;
    for (int i = 0; i <= 64; ++i) {
        const float light = luminanceOf(packedPixel(heatColor(static_cast<float>(i) / 64.0f)));
        EXPECT_GT(light, before) << i;
        before = light;
    }
    EXPECT_EQ(heatColor(1.0f), heatColor(17.0f));
    EXPECT_EQ(heatColor(0.0f), heatColor(-1.0f));
    EXPECT_EQ(heatColor(0.0f), heatColor(std::numeric_limits<float>::quiet_NaN()));
}

// B. Ottosson's test values: the XYZ white of D65 is white in sRGB.
TEST(OklabColor, hasWhiteAndGreysOnItsAxis) {
    for (const float lightness : {0.25f, 0.5f, 1.0f}) {
        const vec3 grey = oklabColor(lightness, 0.0f, 0.0f);
        EXPECT_LT(largest(abs(grey - vec3(lightness * lightness * lightness))), 1e-4f);
    }
}

TEST(IdColor, differsFromIdToIdAndStaysReadable) {
    std::set<std::uint32_t> colors;
    for (std::uint32_t id = 0; id < 4096; ++id) {
        const std::uint32_t pixel = packedLinear(idColor(id));
        colors.insert(pixel);
        const float light = luminanceOf(pixel);
        EXPECT_GT(light, 0.15f) << id;
        EXPECT_LT(light, 0.75f) << id;
    }
    EXPECT_GT(colors.size(), 4000u);
}

} // namespace
} // namespace metamarch
