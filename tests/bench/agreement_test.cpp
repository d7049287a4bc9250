// SPDX-License-Identifier: MIT
// Compares every traversal with the judge on every shared scene with every ray set. This takes half an hour,
// so CTest does not run it; tools/test --long does.
#include "fixtures/ray_sets.h"
#include "fixtures/shared_scenes.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/bench/cpu_tracer.h"
#include "metamarch/bench/hit_check.h"
#include "metamarch/bench/ray_set.h"
#include "metamarch/error/error.h"
#include "metamarch/render/ray_tracer.h"
#include "metamarch/scene/import.h"
#include "metamarch/shaders/shader_library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <set>

namespace metamarch::bench {
namespace {

constexpr std::uint32_t kWidth = 161; // of each of the four views; not a multiple of a tile's
constexpr std::uint32_t kHeight = 119;
constexpr std::uint32_t kTrickyRays = 200000;
constexpr std::size_t kBruteForceRays = 1000; // of each set, because each ray tests every triangle
constexpr std::uint32_t kBruteForceTriangles = 1u << 19u; // llvmpipe's loops end after this number

std::vector<std::filesystem::path> sceneFiles() {
    std::vector<std::filesystem::path> files;
    if (const auto folder = tests::findSharedScenes()) {
        const std::set<std::string> endings{".glb", ".gltf", ".obj", ".off", ".ply", ".stl"};
        for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder)) {
            if (endings.contains(entry.path().extension().string())) {
                files.push_back(entry.path());
            }
        }
    }
    std::ranges::sort(files);
    return files;
}

struct NamedRays {
    std::string name;
    RaySet set;
};

std::vector<NamedRays> allRays(const Scene& scene, const AccelerationStructure& structure) {
    std::vector<NamedRays> sets;
    for (const std::string& name : raySetNames()) {
        sets.push_back({name, makeRaySet(name, scene, structure, kWidth, kHeight)});
    }
    if (!scene.triangles.empty()) {
        const std::vector<RayQuery> tricky = tests::trickyRays(scene, structure, kTrickyRays, 31);
        sets.push_back({"tricky", {tricky, HitQuery::closest}});
        sets.push_back({"tricky, any hit", {tricky, HitQuery::any}});
    }
    return sets;
}

// Returns the number of rays, at most `count`, that a traversal is tested with.
std::size_t raysFor(const std::string_view traversal, const std::size_t count, const Lattice& lattice) {
    if (traversal != "brute_force") {
        return count;
    }
    return lattice.triangleCount <= kBruteForceTriangles ? std::min(count, kBruteForceRays) : 0;
}

class Agreement : public testing::TestWithParam<std::filesystem::path> {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    const vulkan::Device& device = vulkan::testDevice();
};

TEST_P(Agreement, everyTraversalHitsWhatTheJudgeHits) {
    Scene scene;
    try {
        scene = loadScene(GetParam());
    } catch (const Error& error) {
        ASSERT_EQ(error.kind, ErrorKind::inputRefused);
        GTEST_SKIP() << "refused: " << error.what(); // the tests of the import judge this
    }
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const ShadingData shading = makeShadingData(scene);
    const render::SceneBuffers buffers(device, structure, shading);
    const HitTolerance tolerance = toleranceOn(device.report().keepsBits(), structure.lattice);
    for (const auto& [name, set] : allRays(scene, structure)) {
        const std::vector<RayResult> judged = judge(structure, set.rays, set.query).results;
        for (const std::string_view traversal : traversals()) {
            if (!render::missingFor(device.report(), traversal).empty()) {
                continue;
            }
            const std::size_t count = raysFor(traversal, set.rays.size(), structure.lattice);
            const std::span<const RayQuery> rays = std::span(set.rays).first(count);
            render::RayTracer tracer(device, buffers, std::string(traversal), set.query == HitQuery::any);
            const std::uint64_t different = countDifferent(
                rays, tracer.trace(rays), std::span(judged).first(count), set.query, tolerance);
            EXPECT_TRUE(isWithinBudget(different, count, tolerance))
                << traversal << ", " << name << " rays: " << different << " of " << count << " differ";
        }
    }
}

std::string testName(const testing::TestParamInfo<std::filesystem::path>& instance) {
    std::string name = instance.param.filename().string();
    std::ranges::replace_if(
        name, [](const unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name + "_" + std::to_string(instance.index); // two folders may have files with the same name
}

// Without the shared scenes, Agreement has no instances; this test then reports it.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Agreement);
TEST(AgreementScenes, areThere) { EXPECT_FALSE(tests::sharedScene("").empty()); }

INSTANTIATE_TEST_SUITE_P(SharedScenes, Agreement, testing::ValuesIn(sceneFiles()), testName);

} // namespace
} // namespace metamarch::bench
