// SPDX-License-Identifier: MIT
// Shading normals that disagree with the triangle: no light leaks, and no mirror turns black.
#include "looks.h"
#include "random_bsdf_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamarch {
namespace {

constexpr vec3 kUp(0.0f, 0.0f, 1.0f);

TEST(SurfaceFrames, flatSurfaceIsNotBentEvenAtGrazing) {
    for (const float cosine : {1.0f, 0.1f, 1e-3f, 1e-6f}) {
        const SurfaceFrame frame =
            makeSurfaceFrame(kUp, kUp, kUp, vec3(1.0f, 0.0f, 0.0f), directionOf(cosine));
        EXPECT_EQ(frame.normal, kUp);
        EXPECT_EQ(frame.coatNormal, kUp);
        EXPECT_EQ(frame.tangent, vec3(1.0f, 0.0f, 0.0f));
    }
}

TEST(SurfaceFrames, backIsSeenFromTheBack) {
    const SurfaceFrame frame = makeSurfaceFrame(kUp, kUp, kUp, vec3(0.0f), directionOf(-0.5f));
    EXPECT_EQ(frame.isBack, 1u);
    EXPECT_EQ(frame.geometricNormal, -kUp);
    EXPECT_EQ(frame.normal, -kUp);
}

TEST(SurfaceFrames, areOrthonormalAndMirrorUpwards) {
    for (const BsdfCase& asked : randomBsdfCases(50'000)) {
        const SurfaceFrame frame = makeSurfaceFrame(asked.geometricNormal, asked.shadingNormal,
                                                    asked.coatNormal, asked.tangent, asked.wo);
        ASSERT_GE(dotProduct(frame.geometricNormal, asked.wo), 0.0f);
        for (const vec3& axis : {frame.tangent, frame.bitangent, frame.normal, frame.coatNormal}) {
            ASSERT_NEAR(dotProduct(axis, axis), 1.0f, 1e-5f);
        }
        ASSERT_NEAR(dotProduct(frame.tangent, frame.normal), 0.0f, 1e-4f);
        ASSERT_NEAR(dotProduct(frame.bitangent, frame.normal), 0.0f, 1e-4f);
        for (const vec3& normal : {frame.normal, frame.coatNormal}) {
            ASSERT_GT(dotProduct(normal, asked.wo), -1e-6f);
            const vec3 mirrored = normal * (2.0f * dotProduct(normal, asked.wo)) - asked.wo;
            ASSERT_GT(dotProduct(mirrored, frame.geometricNormal), -1e-6f);
        }
    }
}

TEST(SurfaceFrames, normalAgainstTheTriangleIsTurned) {
    const vec3 wo = directionOf(0.9f);
    EXPECT_EQ(makeSurfaceFrame(kUp, -kUp, -kUp, vec3(0.0f), wo).normal, kUp);
}

// An opaque surface does not show what lies behind the triangle, whatever its shading normal is.
TEST(SurfaceFrames, noLightLeaks) {
    int lit = 0;
    for (const BsdfCase& asked : randomBsdfCases(50'000)) {
        SurfaceMaterial material = asked.material;
        material.transmission = 0.0f;
        material.diffuseTransmission = 0.0f;
        const SurfaceFrame frame = makeSurfaceFrame(asked.geometricNormal, asked.shadingNormal,
                                                    asked.coatNormal, asked.tangent, asked.wo);
        const Bsdf bsdf = makeBsdf(material, frame, asked.wo);
        const bool isBehind = dotProduct(asked.wi, frame.geometricNormal) <= 0.0f;
        const vec3 value = evalBsdf(bsdf, asked.wi).value;
        if (isBehind) {
            ASSERT_EQ(value, vec3(0.0f));
        }
        lit += value.x > 0.0f ? 1 : 0;
        const BsdfSample drawn = sampleBsdf(bsdf, asked.uLobe, vec2(asked.uDirectionX, asked.uDirectionY));
        if (dotProduct(drawn.wi, frame.geometricNormal) <= 0.0f) {
            ASSERT_EQ(drawn.weight, vec3(0.0f));
        }
    }
    EXPECT_GT(lit, 10'000);
}

// The bent normal's mirror direction sees the sky where the original normal's would point into the surface.
TEST(SurfaceFrames, bumpyMirrorAtGrazingIsNotBlack) {
    SurfaceMaterial material = plainMaterial();
    material.metallic = 1.0f;
    material.roughness = 0.0f;
    const vec3 wo = directionOf(0.1f);
    const vec3 leaning = unitVector(vec3(-0.8f, -0.6f, 1.0f)); // leans away from wo
    const Bsdf bsdf = makeBsdf(material, makeSurfaceFrame(kUp, leaning, leaning, vec3(0.0f), wo), wo);
    const BsdfSample drawn = sampleBsdf(bsdf, 0.5f, vec2(0.5f, 0.5f));
    EXPECT_GT(drawn.wi.z, 0.0f);
    EXPECT_NEAR(drawn.weight.x, 1.0f, 1e-6f);
}

} // namespace
} // namespace metamarch
