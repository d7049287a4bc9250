// SPDX-License-Identifier: MIT
// Compares every traversal on the device with the judges, ray by ray and pixel by pixel, under validation.
#include "fixtures/ray_sets.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/bench/hit_check.h"
#include "metamarch/reference/primary.h"
#include "metamarch/reference/twins.h"
#include "metamarch/render/primary_renderer.h"
#include "metamarch/render/ray_tracer.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/view.h"
#include "traversal/gpu_scenes.h"
#include "traversal/judges.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string_view>

namespace metamarch::tests {
namespace {

constexpr std::uint32_t kBruteForceRays = 10000;

// Rays of a scene. METAMARCH_LONG=1, as `tools/test --long` sets it, takes a million.
std::uint32_t rayCount() {
    const char* const isLong = std::getenv("METAMARCH_LONG");
    return isLong != nullptr && std::string_view(isLong) == "1" ? 1000000 : 200000;
}

constexpr std::string_view kBruteForce = "brute_force";

// The default traversal gets the full work, the others less. The slowest ones, and scenes in which a ray
// takes thousands of tests, get little, so that the tests are quick.
struct Effort {
    std::size_t rays;
    std::size_t views;
    std::uint32_t width; // not whole tiles
    std::uint32_t height;
};

Effort effortFor(const std::string_view traversal, const GpuScene& scene) {
    if (traversal == traversals().front()) {
        return {rayCount(), 5, 321, 239};
    }
    return traversal == kBruteForce ? Effort{1000, 1, 33, 25}
           : scene.inStadium        ? Effort{rayCount() / 100, 1, 65, 49}
                                    : Effort{rayCount() / 4, 1, 161, 119};
}

// Returns the traversals that the device can run, and prints the others.
std::vector<std::string_view> offeredTraversals(const vulkan::Device& device) {
    std::vector<std::string_view> offered;
    for (const std::string_view traversal : traversals()) {
        if (render::missingFor(device.report(), traversal).empty()) {
            offered.push_back(traversal);
        } else {
            std::cerr << device.name() << " cannot run " << traversal << "\n";
        }
    }
    return offered;
}

// Expects the hits of the CPU: bit by bit where the device keeps bits, elsewhere within the benchmark's
// tolerance.
void expectHitsOfCpu(const Lattice& lattice, const std::span<const RayQuery> rays,
                     const std::vector<RayResult>& results, const std::span<const RayResult> expected,
                     const HitQuery query, const Counters counters) {
    if (vulkan::testDevice().report().keepsBits() && query == HitQuery::any &&
        counters == Counters::ignored) {
        expectSameOcclusion(rays, results, expected);
    } else if (vulkan::testDevice().report().keepsBits()) {
        expectSameHits(rays, results, expected, counters);
    } else {
        const auto tolerance = bench::toleranceOn(false, lattice);
        const std::uint64_t different = bench::countDifferent(rays, results, expected, query, tolerance);
        EXPECT_TRUE(bench::isWithinBudget(different, rays.size(), tolerance)) << different << " rays";
    }
}

struct LoadedScene {
    Scene scene;
    AccelerationStructure structure;
    ShadingData shading;
};

LoadedScene prepare(const GpuScene& gpuScene) {
    Scene scene = load(gpuScene);
    AccelerationStructure structure = buildAccelerationStructure(scene, gpuScene.options);
    ShadingData shading = makeShadingData(scene);
    return {std::move(scene), std::move(structure), std::move(shading)};
}

class Gpu : public testing::TestWithParam<GpuScene> {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    const vulkan::Device& device = vulkan::testDevice();
};

TEST_P(Gpu, hitsWhatTheJudgesHit) {
    const LoadedScene loaded = prepare(GetParam());
    const AccelerationStructure& structure = loaded.structure;
    const StructureSet structures(structure);
    const std::vector<RayQuery> rays = trickyRays(loaded.scene, structure, rayCount(), 11);
    const auto stack = traceAll(structure.lattice, rays, [&](const Ray& ray) {
        return traceKdStack(structure, ray, HitQuery::closest);
    });
    const std::span<const RayQuery> few = std::span(rays).first(kBruteForceRays);
    const auto brute = traceAll(structure.lattice, few, [&](const Ray& ray) {
        return findTwin(kBruteForce).checked(structures, ray, HitQuery::closest);
    });
    expectSameHits(few, std::span(stack).first(kBruteForceRays), brute, Counters::ignored);
    const auto hits = std::count_if(stack.begin(), stack.end(),
                                    [](const RayResult& result) { return result.triangleId != kNoTriangle; });
    EXPECT_GT(hits, rayCount() / 20) << "too few hits for a meaningful test";

    const render::SceneBuffers buffers(device, structure, loaded.shading);
    std::size_t traced = 0; // traversals
    for (const std::string_view traversal : offeredTraversals(device)) {
        SCOPED_TRACE(traversal);
        const std::size_t count = effortFor(traversal, GetParam()).rays;
        const std::span<const RayQuery> some = std::span(rays).first(count);
        const auto onDevice = [&](const bool anyHit) {
            return vulkan::ifTexelsSuffice([&] {
                return render::RayTracer(device, buffers, std::string(traversal), anyHit).trace(some);
            });
        };
        const auto closestOnDevice = onDevice(false);
        if (!closestOnDevice) {
            continue;
        }
        const auto anyOnDevice = onDevice(true).value();
        ++traced;
        if (!hasTwin(traversal)) {
            for (const HitQuery query : {HitQuery::closest, HitQuery::any}) {
                expectHitsOfCpu(structure.lattice, some,
                                query == HitQuery::any ? anyOnDevice : *closestOnDevice,
                                std::span(stack).first(count), query, Counters::ignored);
            }
            continue;
        }
        const auto twin = [&](const HitQuery query) {
            return traceAll(structure.lattice, some, [&](const Ray& ray) {
                return findTwin(traversal).checked(structures, ray, query);
            });
        };
        const auto closest = twin(HitQuery::closest);
        const auto any = twin(HitQuery::any);
        expectSameHits(some, closest, std::span(stack).first(count), Counters::ignored);
        expectSameOcclusion(some, any, std::span(stack).first(count));
        expectHitsOfCpu(structure.lattice, some, *closestOnDevice, closest, HitQuery::closest,
                        Counters::compared);
        expectHitsOfCpu(structure.lattice, some, anyOnDevice, any, HitQuery::any, Counters::compared);
    }
    if (traced == 0) {
        GTEST_SKIP() << "the scene is too large for the device";
    }
}

// Looks at the whole scene along an axis.
SceneCamera axisView(const Bounds& bounds, const glm::vec3 direction, const glm::vec3 up) {
    const glm::vec3 center = 0.5f * (bounds.lo + bounds.hi);
    const float diagonal = glm::length(bounds.hi - bounds.lo);
    return lookAt(center + direction * diagonal, center, up);
}

TEST_P(Gpu, drawsThePicturesTheJudgeDraws) {
    const LoadedScene loaded = prepare(GetParam());
    const Bounds bounds = boundsOf(loaded.scene);
    const render::SceneBuffers buffers(device, loaded.structure, loaded.shading);
    const SceneCamera views[] = {
        frameBounds(bounds, kDefaultVerticalFov, 4.0f / 3.0f),
        axisView(bounds, {0, 0, 1}, {0, 1, 0}),
        axisView(bounds, {0, 1, 0}, {0, 0, -1}),
        axisView(bounds, {-1, 0, 0}, {0, 1, 0}),
        axisView(bounds, {1, 0, 0}, {0, 1, 0}),
    };
    std::size_t drawn = 0; // pictures
    for (const std::string_view traversal : offeredTraversals(device)) {
        const Effort effort = effortFor(traversal, GetParam());
        for (const SceneCamera& view : std::span(views).first(effort.views)) {
            SCOPED_TRACE(testing::Message() << traversal << " looking along " << view.forward.x << " "
                                            << view.forward.y << " " << view.forward.z);
            const Camera camera = makeCamera(view, effort.width, effort.height);
            const auto expected = renderPrimaryByJudge(loaded.structure, loaded.shading.materials,
                                                       loaded.shading.materialOfTriangle, camera);
            const auto result = vulkan::ifTexelsSuffice([&] {
                return render::renderPrimaryOnDevice(device, buffers, std::string(traversal), camera);
            });
            if (!result) {
                continue;
            }
            ++drawn;
            std::size_t different = 0;
            for (std::size_t i = 0; i < expected.size(); ++i) {
                // Compare all bits except steps and tests, or what is seen.
                const FilmPixel& pixel = result->film.pixels[i];
                const bool isSame = vulkan::testDevice().report().keepsBits()
                                        ? std::memcmp(&pixel, &expected[i], offsetof(FilmPixel, steps)) == 0
                                        : pixel.seen.triangleId == expected[i].seen.triangleId;
                different += isSame ? 0 : 1;
            }
            // One pixel in a thousand may show another triangle's edge where a device rounds otherwise.
            const std::size_t budget =
                vulkan::testDevice().report().keepsBits() ? 0 : expected.size() / 1000 + 1;
            EXPECT_LE(different, budget) << "pixels";
        }
    }
    if (drawn == 0) {
        GTEST_SKIP() << "the scene is too large for the device";
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gpu, testing::ValuesIn(gpuScenes()),
                         [](const auto& instance) { return instance.param.name; });

} // namespace
} // namespace metamarch::tests
