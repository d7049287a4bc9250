// SPDX-License-Identifier: MIT
// The BSDF's samples have the claimed density, and their weights agree with its values.
#include "chi_square.h"
#include "looks.h"
#include "metamarch/shared/bsdf.h"
#include "random_bsdf_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace metamarch {
namespace {

constexpr int kSamples = 60'000;

class BsdfSampling : public testing::TestWithParam<Look> {};

// Directions from steep to grazing and from the back; with normals that agree and one that does not.
constexpr float kCosines[] = {1.0f, 0.7f, 0.25f, -0.6f};
constexpr float kTilts[] = {0.0f, 0.5f};
constexpr int kTests = std::size(kCosines) * std::size(kTilts) * kLooks;

TEST_P(BsdfSampling, fallsWhereItsDensitySays) {
    for (const float cosine : kCosines) {
        for (const float tilt : kTilts) {
            const vec3 wo = directionOf(cosine);
            const SurfaceFrame frame = tiltedFrame(wo, tilt);
            const Bsdf bsdf = makeBsdf(GetParam().material, frame, wo);
            std::mt19937 random(5);
            std::uniform_real_distribution<float> even(0.0f, 0.99999994f);
            const auto draw = [&] {
                const float uLobe = even(random);
                const vec2 uDirection(even(random), even(random));
                const BsdfSample drawn = sampleBsdf(bsdf, uLobe, uDirection);
                const bool isCounted = (drawn.flags & kSampleDelta) == 0u && drawn.pdf > 0.0f;
                return DrawnDirection{isCounted, drawn.wi};
            };
            const auto density = [&](vec3 wi) { return static_cast<double>(evalBsdf(bsdf, wi).pdf); };
            EXPECT_GT(chiSquareProbability(sphereHistogram(kSamples, draw, density)), significanceOf(kTests))
                << "cosine " << cosine << ", tilt " << tilt;
        }
    }
}

TEST_P(BsdfSampling, weightIsValueOverDensity) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> even(0.0f, 0.99999994f);
    for (const float cosine : kCosines) {
        const vec3 wo = directionOf(cosine);
        const Bsdf bsdf = makeBsdf(GetParam().material, tiltedFrame(wo, 0.3f), wo);
        for (int i = 0; i < 2000; ++i) {
            const float uLobe = even(random);
            const BsdfSample drawn = sampleBsdf(bsdf, uLobe, vec2(even(random), even(random)));
            if ((drawn.flags & kSampleDelta) != 0u) {
                ASSERT_EQ(drawn.pdf, 1.0f);
                continue;
            }
            const BsdfValue found = evalBsdf(bsdf, drawn.wi);
            if (drawn.weight == vec3(0.0f)) {
                continue; // lost, or the surface is invisible from there
            }
            ASSERT_EQ(drawn.pdf, found.pdf);
            ASSERT_EQ(drawn.weight, found.value / found.pdf);
            const bool isThrough = dotProduct(drawn.wi, bsdf.frame.normal) < 0.0f;
            ASSERT_EQ((drawn.flags & kSampleTransmitted) != 0u, isThrough);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Looks, BsdfSampling, testing::ValuesIn(looks()), nameOf);

// A delta's weight times its probability is the lobe's value; its direction is the mirror direction.
TEST(BsdfDelta, mirrorReflectsAtTheNormal) {
    SurfaceMaterial material = plainMaterial();
    material.metallic = 1.0f;
    material.roughness = 0.0f;
    material.baseColor = vec3(0.5f, 0.6f, 0.7f);
    const vec3 wo = directionOf(0.6f);
    const Bsdf bsdf = makeBsdf(material, tiltedFrame(wo, 0.0f), wo);
    EXPECT_TRUE(bsdf.isDelta);
    const BsdfSample drawn = sampleBsdf(bsdf, 0.5f, vec2(0.3f, 0.8f));
    EXPECT_EQ(drawn.flags, kSampleDelta);
    EXPECT_NEAR(drawn.wi.x, -wo.x, 1e-6f);
    EXPECT_NEAR(drawn.wi.y, -wo.y, 1e-6f);
    EXPECT_NEAR(drawn.wi.z, wo.z, 1e-6f);
    EXPECT_NEAR(drawn.weight.x, 0.5f + 0.5f * std::pow(0.4f, 5.0f), 1e-6f);
    EXPECT_EQ(evalBsdf(bsdf, drawn.wi).value, vec3(0.0f)); // only the sampler can find it
}

TEST(BsdfDelta, thinGlassLetsTheRayStraightThrough) {
    SurfaceMaterial material = plainMaterial();
    material.roughness = 0.0f;
    material.transmission = 1.0f;
    material.baseColor = vec3(0.5f, 1.0f, 0.25f);
    const vec3 wo = directionOf(1.0f);
    const Bsdf bsdf = makeBsdf(material, tiltedFrame(wo, 0.0f), wo);
    const BsdfSample drawn = sampleBsdf(bsdf, 0.99f, vec2(0.3f, 0.8f));
    EXPECT_EQ(drawn.flags, kSampleDelta | kSampleTransmitted);
    EXPECT_NEAR(dotProduct(drawn.wi, wo), -1.0f, 1e-6f);
    EXPECT_EQ(drawn.radianceScale, 1.0f);
    // 0.96 * color, divided by the probability of transmission: the fraction of the luminance that is
    // transmitted.
    const float passing = 0.96f * luminance(material.baseColor);
    EXPECT_NEAR(drawn.weight.y, 0.96f / (passing / (passing + 0.04f)), 1e-5f);
}

TEST(BsdfDelta, coatIsAMirrorOverTheRoughBase) {
    SurfaceMaterial material = plainMaterial();
    material.coat = 1.0f;
    const vec3 wo = directionOf(0.5f);
    const Bsdf bsdf = makeBsdf(material, tiltedFrame(wo, 0.0f), wo);
    EXPECT_FALSE(bsdf.isDelta);
    EXPECT_GT(bsdf.pCoat, 0.0f);
    const BsdfSample drawn = sampleBsdf(bsdf, 0.99999f, vec2(0.3f, 0.8f));
    EXPECT_EQ(drawn.flags, kSampleDelta);
    EXPECT_NEAR(drawn.wi.z, wo.z, 1e-6f);
    EXPECT_NEAR(drawn.weight.x * bsdf.pCoat, 0.04f + 0.96f * std::pow(0.5f, 5.0f), 1e-6f);
}

TEST(BsdfDelta, blackSurfaceEndsThePath) {
    SurfaceMaterial material = plainMaterial();
    material.baseColor = vec3(0.0f);
    material.specular = 0.0f;
    const vec3 wo = directionOf(0.5f);
    const Bsdf bsdf = makeBsdf(material, tiltedFrame(wo, 0.0f), wo);
    for (const float uLobe : {0.0f, 0.5f, 0.99999994f}) {
        EXPECT_EQ(sampleBsdf(bsdf, uLobe, vec2(0.1f, 0.9f)).weight, vec3(0.0f));
    }
}

} // namespace
} // namespace metamarch
