// SPDX-License-Identifier: MIT
// The device computes the shared shading functions to the bit like the CPU.
#include "camera_case.h"
#include "fixtures/vulkan_environment.h"
#include "kernel_run.h"
#include "kernels/bsdf.h"
#include "kernels/camera.h"
#include "kernels/light.h"
#include "kernels/math.h"
#include "light_case.h"
#include "math_case.h"
#include "metamarch/shading/view.h"
#include "random_bsdf_case.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

namespace metamarch::vulkan {
namespace {

constexpr std::size_t kCases = 1u << 16;

// A device may take numbers below the smallest normal one as 0 (Vulkan 1.2, "Precision and Operation of
// SPIR-V Instructions"). SwiftShader does.
BsdfAnswer withoutDenormals(BsdfAnswer answer) {
    if (testDevice().report().driver.starts_with("SwiftShader")) {
        for (vec3* const vector : {&answer.value, &answer.sampleWi, &answer.sampleWeight, &answer.albedo}) {
            for (int i = 0; i < 3; ++i) {
                (*vector)[i] = std::abs((*vector)[i]) < FLT_MIN ? 0.0f : (*vector)[i];
            }
        }
        for (float* const number : {&answer.pdf, &answer.samplePdf, &answer.emissionScale}) {
            *number = std::abs(*number) < FLT_MIN ? 0.0f : *number;
        }
    }
    return answer;
}

// Compares every byte with the CPU's result, after `change` where one is given.
template <class Case, class Answer, class Change = std::identity>
void expectSameBits(const std::vector<Case>& cases, const std::vector<Answer>& answers,
                    const Change change = {}) {
    using Words = std::array<std::uint32_t, sizeof(Answer) / sizeof(std::uint32_t)>;
    std::size_t different = 0;
    std::size_t first = 0;
    for (std::size_t i = cases.size(); i-- > 0;) {
        if (std::bit_cast<Words>(change(answer(cases[i]))) != std::bit_cast<Words>(change(answers[i]))) {
            ++different;
            first = i;
        }
    }
    EXPECT_EQ(different, 0u) << "the first of them is case " << first;
}

TEST(ShadingOnDevice, mathAndSamplesHaveTheBitsOfTheCpu) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> even(-1.0f, 1.0f);
    std::uniform_int_distribution<uint> whole(0, 100'000);
    std::normal_distribution<float> normal;
    std::vector<MathCase> cases(kCases);
    for (MathCase& asked : cases) {
        asked.direction = unitVector(vec3(normal(random), normal(random), normal(random)));
        asked.x = even(random);
        asked.pixelX = whole(random);
        asked.pixelY = whole(random);
        asked.index = whole(random);
        asked.dimension = whole(random);
    }
    expectSameBits(cases, runKernel<MathAnswer>(mathSpirv, "math", cases));
}

TEST(ShadingOnDevice, cameraRaysHaveTheBitsOfTheCpu) {
    std::mt19937 random(18);
    std::uniform_real_distribution<float> even(0.0f, 0.99999994f);
    constexpr uint kWidth = 1280;
    constexpr uint kHeight = 720;
    std::vector<CameraCase> cases(kCases);
    for (std::size_t i = 0; i < kCases; ++i) {
        SceneCamera view = lookAt({even(random), even(random), even(random)}, {even(random), -1.0f, 3.0f},
                                  {0.0f, 1.0f, 0.0f});
        view.projection =
            i & 1u ? SceneCamera::Projection::perspective : SceneCamera::Projection::orthographic;
        CameraOptions options;
        options.pixelFilter = static_cast<uint>(i % 3);
        options.isPanorama = i % 5 == 0;
        options.apertureRadius = i & 2u && !options.isPanorama ? even(random) : 0.0f;
        options.focusDistance = 0.1f + 10.0f * even(random);
        CameraCase& asked = cases[i];
        asked.camera = makeCamera(view, kWidth, kHeight, options);
        asked.x = static_cast<uint>(random() % kWidth);
        asked.y = static_cast<uint>(random() % kHeight);
        asked.uFilterX = even(random);
        asked.uFilterY = even(random);
        asked.uLensX = even(random);
        asked.uLensY = even(random);
    }
    expectSameBits(cases, runKernel<CameraAnswer>(cameraSpirv, "camera", cases));
}

TEST(ShadingOnDevice, lightsAndMapsHaveTheBitsOfTheCpu) {
    std::mt19937 random(19);
    std::uniform_real_distribution<float> even(0.0f, 0.99999994f);
    std::normal_distribution<float> normal;
    const auto direction = [&] { return unitVector(vec3(normal(random), normal(random), normal(random))); };
    std::vector<LightCase> cases(kCases);
    for (LightCase& asked : cases) {
        LightRecord& light = asked.light;
        light.position = vec3(normal(random), normal(random), normal(random));
        light.kind = static_cast<uint>(random() % 4);
        light.direction = direction();
        light.strength = vec3(even(random), even(random), even(random));
        const vec2 falloff = makeSpotFalloff(0.5f + 0.5f * even(random), even(random) - 0.5f);
        light.scale = light.kind == kLightDisc ? 0.1f * even(random) : falloff.x;
        light.offset = falloff.y;
        asked.point = vec3(normal(random), normal(random), normal(random));
        asked.direction = random() % 2 == 0 ? direction() : light.direction;
        asked.uX = even(random);
        asked.uY = even(random);
        asked.keep = even(random);
        asked.slotCount = 1 + static_cast<uint>(random() % 5000);
        asked.other = static_cast<uint>(random() % asked.slotCount);
        asked.density = 0.01f + even(random);
    }
    expectSameBits(cases, runKernel<LightAnswer>(lightSpirv, "light", cases));
}

TEST(ShadingOnDevice, bsdfHasTheBitsOfTheCpu) {
    const std::vector<BsdfCase> cases = randomBsdfCases(kCases);
    KernelTimes times;
    expectSameBits(cases, runKernel<BsdfAnswer>(bsdfSpirv, "bsdf", cases, {}, &times), withoutDenormals);
    RecordProperty("firstRunMilliseconds", static_cast<int>(times.first * 1e3));
    RecordProperty("nanosecondsPerCase", static_cast<int>(times.again * 1e9 / kCases));
}

// For a material that does not use a feature, a kernel without the feature computes the same as the CPU,
// which has all features.
TEST(ShadingOnDevice, bsdfWithoutUnusedFeaturesHasTheSameBits) {
    constexpr uint32_t kFeatures = 0; // constant_id
    const std::vector<BsdfCase> all = randomBsdfCases(kCases / 4);
    for (uint32_t features = 0; features < kBsdfFeatures; ++features) {
        if ((features & (features - 1)) != 0 && features != (kFeatureTransmission | kFeatureVolume)) {
            continue; // only: no feature, one, or refraction
        }
        std::vector<BsdfCase> cases = all;
        for (BsdfCase& asked : cases) {
            SurfaceMaterial& material = asked.material;
            const auto uses = [&](uint32_t feature) { return (features & feature) != 0; };
            material.coat = uses(kFeatureCoat) ? material.coat : 0.0f;
            material.sheenColor = uses(kFeatureSheen) ? material.sheenColor : vec3(0.0f);
            material.transmission = uses(kFeatureTransmission) ? material.transmission : 0.0f;
            material.flags &= uses(kFeatureVolume) ? ~0u : ~kSurfaceVolume;
            material.iridescence = uses(kFeatureIridescence) ? material.iridescence : 0.0f;
            material.diffuseTransmission =
                uses(kFeatureDiffuseTransmission) ? material.diffuseTransmission : 0.0f;
        }
        SCOPED_TRACE(features);
        const uint32_t compiled = features | kFeatureFacets;
        expectSameBits(cases, runKernel<BsdfAnswer>(bsdfSpirv, "bsdf", cases, {{kFeatures, compiled}}),
                       withoutDenormals);
    }
}

TEST(ShadingOnDevice, diffuseSurfacesWithoutFacetsHaveTheSameBits) {
    constexpr uint32_t kFeatures = 0; // constant_id
    std::vector<BsdfCase> cases = randomBsdfCases(kCases / 4);
    for (BsdfCase& asked : cases) {
        SurfaceMaterial& material = asked.material;
        material.metallic = 0.0f;
        material.specular = 0.0f;
        material.coat = 0.0f;
        material.sheenColor = vec3(0.0f);
        material.transmission = 0.0f;
        material.flags &= ~kSurfaceVolume;
        material.iridescence = 0.0f;
        material.diffuseTransmission = 0.0f;
    }
    expectSameBits(cases, runKernel<BsdfAnswer>(bsdfSpirv, "bsdf", cases, {{kFeatures, 0u}}),
                   withoutDenormals);
}

} // namespace
} // namespace metamarch::vulkan
