// Every traversal on the device against the judges, ray by ray and pixel by pixel, with the validation layers
// on.
#include "fixtures/ray_sets.h"
#include "fixtures/vulkan_environment.h"
#include "reference/primary.h"
#include "render/primary_renderer.h"
#include "render/ray_tracer.h"
#include "scene/view.h"
#include "shader_library.h"
#include "traversal/gpu_scenes.h"
#include "traversal/judges.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

namespace metamarch::tests {
namespace {

constexpr std::uint32_t kRays = 1000000;
constexpr std::uint32_t kBruteForceRays = 10000;

struct LoadedScene {
    Scene scene;
    AccelerationStructure structure;
    ShadingData shading;
};

std::optional<LoadedScene> prepare(const GpuScene& gpuScene) {
    std::optional<Scene> scene = load(gpuScene);
    if (!scene) {
        return std::nullopt;
    }
    AccelerationStructure structure = buildAccelerationStructure(*scene, gpuScene.options);
    ShadingData shading = makeShadingData(*scene);
    return LoadedScene{std::move(*scene), std::move(structure), std::move(shading)};
}

class Gpu : public testing::TestWithParam<GpuScene> {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    const vulkan::Device& device = vulkan::testDevice();
};

TEST_P(Gpu, hitsWhatTheJudgesHit) {
    const std::optional<LoadedScene> loaded = prepare(GetParam());
    if (!loaded) {
        return;
    }
    const AccelerationStructure& structure = loaded->structure;
    const std::vector<RayQuery> rays = trickyRays(loaded->scene, structure, kRays, 11);
    const auto stack = traceAll(structure.lattice, rays, [&](const Ray& ray) {
        return traceKdStack(structure, ray, HitQuery::closest);
    });
    const auto march = traceAll(structure.lattice, rays, [&](const Ray& ray) {
        return traceMetaTable(structure, ray, HitQuery::closest);
    });
    expectSameHits(rays, march, stack, Counters::ignored);
    const std::span<const RayQuery> few = std::span(rays).first(kBruteForceRays);
    const std::vector<TriangleRecord> triangles =
        makeTriangleRecords(loaded->scene, solidTriangles(loaded->scene));
    const auto brute = traceAll(structure.lattice, few, [&](const Ray& ray) {
        return traceBruteForce(triangles, ray, HitQuery::closest);
    });
    expectSameHits(few, std::span(stack).first(kBruteForceRays), brute, Counters::ignored);
    const auto hits = std::count_if(stack.begin(), stack.end(),
                                    [](const RayResult& result) { return result.triangleId != kNoTriangle; });
    EXPECT_GT(hits, kRays / 20) << "too few hits to mean anything";

    const render::SceneBuffers buffers(device, structure, loaded->shading);
    for (const std::string_view traversal : traversals()) {
        SCOPED_TRACE(traversal);
        const Counters counters = traversal == "meta_table" ? Counters::compared : Counters::ignored;
        const std::string name(traversal);
        expectSameHits(rays, render::RayTracer(device, buffers, name, false).trace(rays), march, counters);
        expectSameOcclusion(rays, render::RayTracer(device, buffers, name, true).trace(rays), stack);
    }
}

// Looks at the whole scene along an axis.
SceneCamera axisView(const Bounds& bounds, const glm::vec3 direction, const glm::vec3 up) {
    const glm::vec3 center = 0.5f * (bounds.lo + bounds.hi);
    const float diagonal = glm::length(bounds.hi - bounds.lo);
    return lookAt(center + direction * diagonal, center, up);
}

TEST_P(Gpu, drawsThePicturesTheJudgeDraws) {
    const std::optional<LoadedScene> loaded = prepare(GetParam());
    if (!loaded) {
        return;
    }
    const Bounds bounds = boundsOf(loaded->scene);
    const render::SceneBuffers buffers(device, loaded->structure, loaded->shading);
    const SceneCamera views[] = {
        axisView(bounds, {0, 0, 1}, {0, 1, 0}),
        axisView(bounds, {0, 1, 0}, {0, 0, -1}),
        axisView(bounds, {-1, 0, 0}, {0, 1, 0}),
        axisView(bounds, {1, 0, 0}, {0, 1, 0}),
        frameBounds(bounds, kDefaultVerticalFov, 4.0f / 3.0f),
    };
    for (const SceneCamera& view : views) {
        const Camera camera = makeCamera(view, 321, 239); // not whole tiles
        const auto expected = renderPrimary(loaded->structure, loaded->shading.materials,
                                            loaded->shading.materialOfTriangle, camera, [](unsigned) {});
        for (const std::string_view traversal : traversals()) {
            SCOPED_TRACE(traversal);
            const auto result =
                render::renderPrimary(device, buffers, std::string(traversal), camera, [](double) {});
            std::size_t different = 0;
            for (std::size_t i = 0; i < expected.size(); ++i) {
                // All but steps and tests, bit for bit.
                different +=
                    std::memcmp(&result.pixels[i], &expected[i], offsetof(PrimaryPixel, steps)) == 0 ? 0 : 1;
            }
            EXPECT_EQ(different, 0u) << "pixels, looking along " << view.forward.x << " " << view.forward.y
                                     << " " << view.forward.z;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gpu, testing::ValuesIn(gpuScenes()),
                         [](const auto& instance) { return instance.param.name; });

} // namespace
} // namespace metamarch::tests
