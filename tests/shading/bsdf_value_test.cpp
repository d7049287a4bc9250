// SPDX-License-Identifier: MIT
// The BSDF's values: glTF 2.0, Appendix B worked out by hand, reciprocity, Snell and Fresnel.
#include "looks.h"
#include "random_bsdf_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace metamarch {
namespace {

constexpr vec3 kUp(0.0f, 0.0f, 1.0f);

BsdfValue valueOf(const SurfaceMaterial& material, vec3 wo, vec3 wi) {
    return evalBsdf(makeBsdf(material, tiltedFrame(wo, 0.0f), wo), wi);
}

SurfaceMaterial singleScatter(float roughness, float metallic) {
    SurfaceMaterial material = plainMaterial();
    material.baseColor = vec3(0.8f, 0.5f, 0.2f);
    material.roughness = roughness;
    material.metallic = metallic;
    material.flags = kSurfaceSingleScatter;
    return material;
}

// At normal incidence D = 1 / (pi alpha^2), V = 1/4 and F = F0.
TEST(AppendixB, normalIncidenceByHand) {
    const float pi = 3.14159265f;
    EXPECT_NEAR(valueOf(singleScatter(1.0f, 1.0f), kUp, kUp).value.x, 0.8f / (4.0f * pi), 1e-7f);
    EXPECT_NEAR(valueOf(singleScatter(0.5f, 1.0f), kUp, kUp).value.y, 0.5f * 16.0f / (4.0f * pi), 1e-6f);
    EXPECT_NEAR(valueOf(singleScatter(1.0f, 0.0f), kUp, kUp).value.z, 0.04f / (4.0f * pi) + 0.96f * 0.2f / pi,
                1e-7f);
}

// wo and wi are 60 degrees off the normal on opposite sides, alpha is 1/4: H = N, D = 16 / pi,
// V = 1 / (2 * 2 * 1/2 * sqrt(1/16 + 15/16 * 1/4)) = 1 / (2 * sqrt(19/64)) = 4 / sqrt(19),
// F = F0 + (1 - F0) / 32.
TEST(AppendixB, sixtyDegreesByHand) {
    const float sine = std::sqrt(0.75f);
    const vec3 wo(sine, 0.0f, 0.5f);
    const vec3 wi(-sine, 0.0f, 0.5f);
    const float specular = 16.0f / 3.14159265f * 4.0f / std::sqrt(19.0f);
    const float metal = 0.8f + 0.2f / 32.0f;
    EXPECT_NEAR(valueOf(singleScatter(0.5f, 1.0f), wo, wi).value.x, 0.5f * metal * specular, 1e-5f);
    const float dielectric = 0.04f + 0.96f / 32.0f;
    EXPECT_NEAR(valueOf(singleScatter(0.5f, 0.0f), wo, wi).value.x,
                0.5f * (dielectric * specular + (1.0f - dielectric) * 0.8f / 3.14159265f), 1e-5f);
}

// The formulas of Appendix B in double precision.
double appendixB(const SurfaceMaterial& material, glm::dvec3 v, glm::dvec3 l, int channel) {
    const double alpha = static_cast<double>(material.roughness) * material.roughness;
    const glm::dvec3 h = glm::normalize(v + l);
    const double squaredAlpha = alpha * alpha;
    const double d = squaredAlpha / (M_PI * std::pow(h.z * h.z * (squaredAlpha - 1.0) + 1.0, 2.0));
    const double vis = 0.5 / (v.z * std::sqrt(squaredAlpha + (1.0 - squaredAlpha) * l.z * l.z) +
                              l.z * std::sqrt(squaredAlpha + (1.0 - squaredAlpha) * v.z * v.z));
    const double weight = std::pow(1.0 - std::abs(glm::dot(v, h)), 5.0);
    const double color = material.baseColor[channel];
    const double dielectric = 0.04 + 0.96 * weight;
    const double dielectricBrdf = (1.0 - dielectric) * color / M_PI + dielectric * vis * d;
    const double metalBrdf = (color + (1.0 - color) * weight) * vis * d;
    return dielectricBrdf + material.metallic * (metalBrdf - dielectricBrdf);
}

vec3 randomAbove(std::mt19937& random) {
    std::uniform_real_distribution<float> even(0.001f, 1.0f);
    const float z = even(random);
    const vec2 circle = circlePoint(even(random));
    const float radius = std::sqrt(1.0f - z * z);
    return vec3(radius * circle.x, radius * circle.y, z);
}

TEST(AppendixB, singleScatterIsTheLetter) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> even;
    for (int i = 0; i < 20'000; ++i) {
        const SurfaceMaterial material = singleScatter(0.1f + 0.9f * even(random), even(random));
        const vec3 wo = randomAbove(random);
        const vec3 wi = randomAbove(random);
        const double letter = appendixB(material, wo, wi, i % 3) * wi.z;
        ASSERT_NEAR(valueOf(material, wo, wi).value[i % 3], letter, 1e-4 * letter + 1e-7);
    }
}

// coated = mix(base, coat * specular, coat * F(N V)).
TEST(AppendixB, clearcoatIsMixedByFresnelAtTheNormal) {
    SurfaceMaterial material = singleScatter(0.7f, 0.0f);
    const vec3 wo = unitVector(vec3(0.3f, 0.2f, 0.6f));
    const vec3 wi = unitVector(vec3(-0.2f, 0.1f, 0.7f));
    const float base = valueOf(material, wo, wi).value.x;
    material.coat = 0.75f;
    material.coatRoughness = 0.4f;
    SurfaceMaterial coat = singleScatter(0.4f, 1.0f);
    coat.baseColor = vec3(1.0f); // makes the Fresnel term 1
    const float fresnel = 0.75f * (0.04f + 0.96f * std::pow(1.0f - wo.z, 5.0f));
    EXPECT_NEAR(valueOf(material, wo, wi).value.x,
                base * (1.0f - fresnel) + valueOf(coat, wo, wi).value.x * fresnel, 1e-6f);
}

// KHR_materials_specular: f0 = min(0.04 color, 1) specular, f90 = specular, and the base keeps 1 - max(f).
TEST(AppendixB, specularExtension) {
    SurfaceMaterial material = singleScatter(1.0f, 0.0f);
    material.specular = 0.5f;
    material.specularColor = vec3(2.0f, 1.0f, 0.0f);
    const float pi = 3.14159265f;
    const vec3 value = valueOf(material, kUp, kUp).value;
    EXPECT_NEAR(value.x, 0.04f / (4.0f * pi) + 0.96f * 0.8f / pi, 1e-7f);
    EXPECT_NEAR(value.y, 0.02f / (4.0f * pi) + 0.96f * 0.5f / pi, 1e-7f);
    EXPECT_NEAR(value.z, 0.96f * 0.2f / pi, 1e-7f);
}

// Returns the BSDF without the cosine, divided by the square of the refractive index on the side of `wi`.
vec3 symmetricPart(const SurfaceMaterial& material, vec3 wo, vec3 wi) {
    const float index = wi.z < 0.0f && (material.flags & kSurfaceVolume) != 0u ? material.ior : 1.0f;
    return valueOf(material, wo, wi).value / std::abs(wi.z) * (index * index);
}

class Reciprocity : public testing::TestWithParam<Look> {};

TEST_P(Reciprocity, holds) {
    std::mt19937 random(2);
    int compared = 0;
    for (int i = 0; i < 20'000; ++i) {
        const vec3 a = randomAbove(random);
        const vec3 b = randomAbove(random) * (i % 2 == 0 ? vec3(1.0f) : vec3(1.0f, 1.0f, -1.0f));
        const vec3 there = symmetricPart(GetParam().material, a, b);
        const vec3 back = symmetricPart(GetParam().material, b, a);
        for (int channel = 0; channel < 3; ++channel) {
            // Near the critical angle 1 - F is small and has few significant bits.
            ASSERT_NEAR(there[channel], back[channel], 1e-3f * there[channel] + 1e-5f) << i;
        }
        compared += there.x > 0.0f ? 1 : 0;
    }
    EXPECT_GT(compared, 3000);
}

std::vector<Look> reciprocalLooks() {
    std::vector<Look> all;
    for (const Look& look : looks()) {
        for (const char* name :
             {"shinyMetal", "metal", "roughMetal", "brushedMetal", "matte", "plastic", "singleScatterPlastic",
              "halfMetal", "thinGlass", "singleScatterThinGlass", "singleScatterGlass", "leaf"}) {
            if (look.name == name) {
                all.push_back(look);
            }
        }
    }
    // Coat and film on their own, because the layers below them are scaled for wo only.
    Look coat{"coat", plainMaterial()};
    coat.material.baseColor = vec3(0.0f);
    coat.material.specular = 0.0f;
    coat.material.coat = 1.0f;
    coat.material.coatRoughness = 0.4f;
    all.push_back(coat);
    Look film{"film", singleScatter(0.5f, 1.0f)};
    film.material.iridescence = 1.0f;
    all.push_back(film);
    return all;
}

INSTANTIATE_TEST_SUITE_P(Looks, Reciprocity, testing::ValuesIn(reciprocalLooks()), nameOf);

TEST(Sheen, lobeIsReciprocal) {
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        const vec3 a = randomAbove(random);
        const vec3 b = randomAbove(random);
        const float half = unitVector(a + b).z;
        const float there = sheenLobe(a.z, b.z, half, 0.5f) / b.z;
        EXPECT_NEAR(there, sheenLobe(b.z, a.z, half, 0.5f) / a.z, 1e-5f * there + 1e-7f);
    }
}

TEST(Fresnel, glassAtNormalIncidence) {
    EXPECT_NEAR(normalReflectance(1.5f), 0.04f, 1e-8f);
    EXPECT_NEAR(refractionAt(1.0f, 1.5f).reflectance, 0.04f, 1e-7f);
    EXPECT_NEAR(refractionAt(1.0f, 1.0f / 1.5f).reflectance, 0.04f, 1e-7f);
    EXPECT_LT(refractionAt(0.3f, 1.0f).reflectance, 1e-12f);
}

TEST(Fresnel, brewstersAngleAndTotalReflection) {
    // At Brewster's angle p-polarised light is not reflected: R = Rs / 2 = ((n^2 - 1) / (n^2 + 1))^2 / 2.
    const float cosine = 1.0f / std::sqrt(1.0f + 1.5f * 1.5f);
    EXPECT_NEAR(refractionAt(cosine, 1.5f).reflectance, 0.5f * std::pow(1.25f / 3.25f, 2.0f), 1e-6f);
    const float critical = std::sqrt(1.0f - 1.0f / (1.5f * 1.5f));
    EXPECT_EQ(refractionAt(critical - 1e-3f, 1.0f / 1.5f).reflectance, 1.0f);
    EXPECT_LT(refractionAt(critical + 1e-3f, 1.0f / 1.5f).reflectance, 1.0f);
}

SurfaceMaterial smoothGlass() {
    SurfaceMaterial material = plainMaterial();
    material.roughness = 0.0f;
    material.transmission = 1.0f;
    material.flags = kSurfaceVolume;
    return material;
}

TEST(Refraction, followsSnell) {
    for (const float degrees : {0.0f, 30.0f, 45.0f, 80.0f}) {
        const float sine = std::sin(degrees * kPi / 180.0f);
        const vec3 wo(sine, 0.0f, std::sqrt(1.0f - sine * sine));
        const Bsdf bsdf = makeBsdf(smoothGlass(), tiltedFrame(wo, 0.0f), wo);
        const BsdfSample drawn = sampleBsdf(bsdf, 0.99999f, vec2(0.5f, 0.5f));
        EXPECT_EQ(drawn.flags, kSampleDelta | kSampleTransmitted);
        EXPECT_NEAR(drawn.wi.x, -sine / 1.5f, 1e-6f) << degrees;
        EXPECT_LT(drawn.wi.z, 0.0f);
        // (1 - F) / (1 - F), radiance divided by 1.5^2.
        EXPECT_NEAR(drawn.weight.x, drawn.radianceScale, 1e-6f);
        EXPECT_NEAR(drawn.radianceScale, 1.0f / 2.25f, 1e-6f);
    }
}

TEST(Refraction, isTotalFromWithin) {
    const vec3 wo(std::sqrt(0.75f), 0.0f, -0.5f); // below the surface, 60 degrees off the normal
    const Bsdf bsdf = makeBsdf(smoothGlass(), tiltedFrame(wo, 0.0f), wo);
    for (const float uLobe : {0.0f, 0.5f, 0.9999f}) {
        const BsdfSample drawn = sampleBsdf(bsdf, uLobe, vec2(0.5f, 0.5f));
        EXPECT_EQ(drawn.flags, kSampleDelta);
        EXPECT_LT(drawn.wi.z, 0.0f);
        EXPECT_NEAR(drawn.weight.x, 1.0f, 1e-6f);
    }
}

TEST(Refraction, equalMediaDoNotBendOrReflect) {
    SurfaceMaterial material = smoothGlass();
    material.ior = 1.0f;
    const vec3 wo = directionOf(0.2f);
    const Bsdf bsdf = makeBsdf(material, tiltedFrame(wo, 0.0f), wo);
    const BsdfSample drawn = sampleBsdf(bsdf, 0.01f, vec2(0.5f, 0.5f));
    EXPECT_EQ(drawn.flags, kSampleDelta | kSampleTransmitted);
    EXPECT_NEAR(dotProduct(drawn.wi, wo), -1.0f, 1e-4f);
}

TEST(Dispersion, spreadsTheIorByTheAbbeNumber) {
    // Dispersion 0.36 is 20 / V: n_F - n_C = (n - 1) * 0.36 / 20.
    EXPECT_NEAR(dispersedIor(2.42f, 0.36f, 2) - dispersedIor(2.42f, 0.36f, 0), 1.42f * 0.36f / 20.0f, 1e-6f);
    EXPECT_EQ(dispersedIor(1.5f, 0.5f, 1), 1.5f);
    EXPECT_GE(dispersedIor(1.1f, 100.0f, 0), 1.0f);
    EXPECT_EQ(channelMask(0) + channelMask(1) + channelMask(2), vec3(3.0f));
}

TEST(BsdfValues, areFiniteAndNotNegative) {
    for (const BsdfCase& asked : randomBsdfCases(100'000)) {
        const BsdfAnswer found = answer(asked);
        for (const vec3& v : {found.value, found.sampleWeight, found.albedo}) {
            ASSERT_TRUE(v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f);
            ASSERT_TRUE(std::isfinite(v.x + v.y + v.z));
        }
        ASSERT_TRUE(found.pdf >= 0.0f && std::isfinite(found.pdf));
        ASSERT_TRUE(found.samplePdf >= 0.0f && std::isfinite(found.samplePdf));
        ASSERT_NEAR(dotProduct(found.sampleWi, found.sampleWi), 1.0f, 1e-5f);
        if (found.pdf == 0.0f) {
            ASSERT_EQ(found.value, vec3(0.0f)); // every direction with a value can be sampled
        }
    }
}

} // namespace
} // namespace metamarch
