// SPDX-License-Identifier: MIT
#include "metamarch/image/tone_mapping.h"
#include "metamarch/shared/packed_pixel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>

namespace metamarch {

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const ToneOperatorName& name, std::ostream* out) { *out << name.name; }

namespace {

// The values were computed by hand from IEC 61966-2-1: 255 * (1.055 * x^(1/2.4) - 0.055), but 255 * 12.92 * x
// for x below 0.0031308.
TEST(ToneMapping, FollowsTheSrgbCurve) {
    EXPECT_EQ(toSrgb8(0.0f), 0u);
    EXPECT_EQ(toSrgb8(0.001f), 3u);   // 3.29, the straight part
    EXPECT_EQ(toSrgb8(0.0031f), 10u); // 10.21
    EXPECT_EQ(toSrgb8(0.18f), 118u);  // 117.6, middle grey
    EXPECT_EQ(toSrgb8(0.5f), 188u);   // 187.5
    EXPECT_EQ(toSrgb8(1.0f), 255u);
}

TEST(ToneMapping, ClampsWhatAScreenCannotShow) {
    EXPECT_EQ(toSrgb8(-1.0f), 0u);
    EXPECT_EQ(toSrgb8(17.0f), 255u);
    EXPECT_EQ(toSrgb8(std::numeric_limits<float>::infinity()), 255u);
    EXPECT_EQ(toSrgb8(-std::numeric_limits<float>::infinity()), 0u);
    EXPECT_EQ(toSrgb8(std::numeric_limits<float>::quiet_NaN()), 0u);
    EXPECT_EQ(toLinear8(std::numeric_limits<float>::quiet_NaN()), 0u);
    EXPECT_EQ(toLinear8(2.0f), 255u);
}

TEST(ToneMapping, NeverFallsAsLightGrows) {
    for (int step = 1; step <= 100000; ++step) {
        ASSERT_LE(toSrgb8(static_cast<float>(step - 1) * 1e-5f), toSrgb8(static_cast<float>(step) * 1e-5f));
    }
}

TEST(ToneMapping, AlphaIsLinear) {
    EXPECT_EQ(toLinear8(0.25f), 64u); // 63.75
    EXPECT_EQ(toLinear8(0.5f), 128u); // 127.5
}

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr ToneMapping kNone = {};
constexpr ToneMapping kNeutral = {.toneOperator = kToneNeutral};
constexpr ToneMapping kAces = {.toneOperator = kToneAces};
constexpr ToneMapping kAgx = {.toneOperator = kToneAgx};

void expectColor(const ToneMapping& mapping, const glm::vec3 radiance, const glm::vec3 expected) {
    const glm::vec3 shown = toneMapped(mapping, radiance);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(shown[channel], expected[channel], 1e-5)
            << "channel " << channel << " of " << radiance.r << "," << radiance.g << "," << radiance.b;
    }
}

TEST(ToneOperators, NoneCutsOff) {
    EXPECT_EQ(toneMapped(kNone, {0.3f, 1.0f, 1.5f}), glm::vec3(0.3f, 1.0f, 1.0f));
    EXPECT_EQ(toneMapped(kNone, {-1.0f, kInf, 1e-30f}), glm::vec3(0.0f, 1.0f, 1e-30f));
}

// Below the start of the compression, and with at least 0.08 in every channel, `neutral` subtracts the light
// that a dielectric reflects under uniform light of radiance 1. The base colour remains.
TEST(ToneOperators, NeutralShowsBaseColours) {
    for (float r = 0.04f; r < 0.759f; r += 0.09f) {
        for (float g = 0.04f; g < 0.759f; g += 0.09f) {
            for (float b = 0.04f; b < 0.759f; b += 0.09f) {
                expectColor(kNeutral, glm::vec3(r, g, b) + 0.04f, {r, g, b});
            }
        }
    }
}

// The values were computed by hand from the specification.
TEST(ToneOperators, NeutralFollowsItsSpecification) {
    expectColor(kNeutral, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f});
    expectColor(kNeutral, {0.04f, 0.5f, 0.04f}, {0.01f, 0.47f, 0.01f});
    expectColor(kNeutral, {1.0f, 1.0f, 1.0f}, glm::vec3(0.8690909f));
    expectColor(kNeutral, {10.0f, 1.0f, 1.0f}, {0.9938983f, 0.6108985f, 0.6108985f});
}

// The values were computed in double precision from the formulas of the sources.
TEST(ToneOperators, AcesFollowsItsFit) {
    expectColor(kAces, {0.18f, 0.18f, 0.18f}, {0.1055912f, 0.1055912f, 0.1055902f});
    expectColor(kAces, {1.0f, 1.0f, 1.0f}, {0.6191154f, 0.6191154f, 0.6191092f});
    expectColor(kAces, {4.0f, 1.0f, 0.25f}, {0.9948911f, 0.6633806f, 0.3166845f});
}

TEST(ToneOperators, AgxFollowsItsFit) {
    expectColor(kAgx, {0.18f, 0.18f, 0.18f}, {0.2144674f, 0.2145326f, 0.2145367f});
    expectColor(kAgx, {1.0f, 1.0f, 1.0f}, {0.5899769f, 0.5902070f, 0.5902214f});
    expectColor(kAgx, {4.0f, 1.0f, 0.25f}, {0.9179268f, 0.6157965f, 0.3749310f});
}

class EveryToneOperator : public testing::TestWithParam<ToneOperatorName> {};

TEST_P(EveryToneOperator, KeepsGreyGreyAndNeverFalls) {
    const ToneMapping mapping = {.toneOperator = GetParam().toneOperator};
    glm::vec3 last(0.0f);
    for (float light = 1e-6f; light < 1e6f; light *= 1.001f) {
        const glm::vec3 shown = toneMapped(mapping, glm::vec3(light));
        ASSERT_NEAR(shown.r, shown.g, 5e-4f) << light; // the rows of AgX's matrices miss 1 by 1.4e-4
        ASSERT_NEAR(shown.b, shown.g, 5e-4f) << light;
        for (int channel = 0; channel < 3; ++channel) {
            ASSERT_GE(shown[channel], last[channel] - 2e-7f) << light;
            ASSERT_LE(shown[channel], 1.0f) << light;
        }
        last = shown;
    }
    EXPECT_EQ(toSrgb8(last.g), 255u);
    EXPECT_EQ(toSrgb8(toneMapped(mapping, glm::vec3(0.0f)).g), 0u);
}

TEST_P(EveryToneOperator, ShowsEveryColourBetweenBlackAndWhite) {
    const ToneMapping mapping = {.toneOperator = GetParam().toneOperator};
    const std::array values = {0.0f, 1e-30f, 0.01f, 0.5f,  1.0f,  7.0f,
                               1e4f, 3e38f,  kInf,  -1.0f, -kInf, std::numeric_limits<float>::quiet_NaN()};
    for (const float r : values) {
        for (const float g : values) {
            for (const float b : values) {
                const glm::vec3 shown = toneMapped(mapping, {r, g, b});
                for (int channel = 0; channel < 3; ++channel) {
                    ASSERT_TRUE(shown[channel] >= 0.0f && shown[channel] <= 1.0f)
                        << r << "," << g << "," << b << " became " << shown[channel];
                }
            }
        }
    }
}

TEST_P(EveryToneOperator, DoublesLightByTheStop) {
    const glm::vec3 radiance(0.3f, 0.2f, 0.05f);
    const ToneMapping brighter = {.toneOperator = GetParam().toneOperator, .exposure = 2.0f};
    const ToneMapping same = {.toneOperator = GetParam().toneOperator};
    EXPECT_EQ(toneMapped(brighter, radiance), toneMapped(same, radiance * 4.0f));
}

INSTANTIATE_TEST_SUITE_P(ToneOperators, EveryToneOperator, testing::ValuesIn(kToneOperators),
                         [](const auto& instance) { return std::string(instance.param.name); });

} // namespace
} // namespace metamarch
