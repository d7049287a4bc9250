// SPDX-License-Identifier: MIT
#include "metamarch/bench/bench_scene.h"

#include "metamarch/bench/structure_cost.h"

#include <algorithm>

namespace metamarch::bench {

BenchScene::BenchScene(std::string sceneName, Scene importedScene, const AccelerationOptions& options)
    : name(std::move(sceneName)), scene(std::move(importedScene)),
      structure(buildAccelerationStructure(scene, options)), shading(makeShadingData(scene)) {}

JudgedRays judgeRays(const BenchScene& scene, std::string name, std::string view, RaySet set) {
    Judgement judged = judge(scene.structure, set.rays, set.query);
    return {std::move(name), std::move(view), std::move(set), std::move(judged)};
}

Row describeRow(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
                const std::string& backend, const std::string& device,
                const std::span<const RayResult> results) {
    Row row{.scene = scene.name,
            .triangles = scene.scene.triangles.size(),
            .rays = rays.name,
            .view = rays.view,
            .traversal = traversal,
            .backend = backend,
            .device = device};
    row.rayCount = results.size();
    std::uint64_t visits = 0;
    std::uint64_t tests = 0;
    for (const RayResult& result : results) {
        row.hits += result.triangleId == kNoTriangle ? 0 : 1;
        visits += result.steps;
        tests += result.tests;
    }
    const auto perRay = [&](const std::uint64_t sum) {
        return static_cast<double>(sum) / static_cast<double>(std::max<std::size_t>(results.size(), 1));
    };
    row.visitsPerRay = perRay(visits);
    row.testsPerRay = perRay(tests);
    if (const auto cost = structureCost(scene.structures, traversal)) {
        row.bytesPerRay = fetchedBytes(*cost, *row.visitsPerRay, *row.testsPerRay);
        row.bytes = cost->bytes;
        row.buildSeconds = cost->buildSeconds;
    }
    return row;
}

} // namespace metamarch::bench
