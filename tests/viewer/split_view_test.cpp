// SPDX-License-Identifier: MIT
// Two traversals side by side: each has its own statistics.
#include "fixtures/vulkan_environment.h"
#include "metamarch/scene/import.h"
#include "metamarch/viewer/split_view.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace metamarch::viewer {
namespace {

constexpr std::uint32_t kSamples = 2;

render::PreparedScene cornell() {
    const auto file = std::filesystem::path(METAMARCH_SOURCE_DIR) / "scenes" / "cornell.glb";
    render::PreparedScene prepared(std::make_shared<const Scene>(loadScene(file)), {});
    prepared.light("cornell.glb", {}, {});
    return prepared;
}

RenderRequest requestFor(const render::PreparedScene& scene) {
    RenderRequest request;
    request.camera = scene.scene->cameras.front();
    request.settings = PathChoice{}.applied(scene.shading->settings);
    request.endSample = kSamples;
    return request;
}

TEST(SplitView, knowsWhatIsCompiled) {
    const vulkan::Device& device = vulkan::testDevice();
    const render::DeviceScene scene(device, cornell());
    const ShaderOverrides none;
    const Backdrop backdrop(device);
    SplitView view(device);
    for (const bool hasPreview : {true, false}) {
        // Returns how often the pictures wait for the driver.
        const auto kernels = [&](const std::vector<std::string>& traversals, const glm::uvec2 size) {
            view.make(scene, traversals, size, none, backdrop);
            RenderRequest request = requestFor(scene.scene());
            request.hasPreview = hasPreview;
            view.start(request);
            int count = 0;
            do {
                count += view.isBeforeKernel() ? 1 : 0;
            } while (view.advance());
            return count;
        };
        EXPECT_EQ(kernels({"meta_table"}, {40, 30}), 1);
        EXPECT_EQ(kernels({"meta_table"}, {50, 30}), 0);
        EXPECT_EQ(kernels({"meta_table", "kd_stack"}, {50, 30}), 1);
        EXPECT_EQ(kernels({"kd_stack"}, {50, 30}), 0);
        view.clear(); // another scene, or other shaders
        EXPECT_EQ(kernels({"kd_stack"}, {50, 30}), 1);
        view.clear();
    }
}

TEST(SplitView, measuresBothSides) {
    const vulkan::Device& device = vulkan::testDevice();
    const render::DeviceScene scene(device, cornell());
    const ShaderOverrides none;
    const Backdrop backdrop(device);
    SplitView view(device);
    view.make(scene, {"meta_table", "kd_stack"}, {40, 30}, none, backdrop);
    view.start(requestFor(scene.scene()));
    while (view.advance()) {
    }

    Statistics statistics;
    while (statistics.framesPerSecond == 0.0) { // rates come from time to time
        view.measure(statistics);
    }
    const auto& [left, right] = statistics.viewports;
    for (const ViewportStatistics& side : {left, right}) {
        EXPECT_EQ(side.samples, kSamples);
        EXPECT_GT(side.seconds, 0.0);
        EXPECT_GT(side.raysPerSecond, 0.0);
        EXPECT_GT(side.samplesPerSecond, 0.0);
    }
    // Both test the same triangles or nearly so, but the steps of the stack are nodes.
    EXPECT_GT(left.stepsPerRay, 0.0);
    EXPECT_GT(right.stepsPerRay, 1.5 * left.stepsPerRay);

    view.make(scene, {"kd_stack"}, {40, 30}, none, backdrop);
    view.measure(statistics);
    EXPECT_EQ(statistics.viewports[0].traversal, "kd_stack");
    EXPECT_EQ(statistics.viewports[0].raysPerSecond, 0.0) << "those of meta_table before";
    EXPECT_EQ(statistics.viewports[1].samples, 0.0);
    EXPECT_EQ(statistics.viewports[1].traversal, "");
    view.clear();
    view.measure(statistics);
    EXPECT_EQ(statistics.viewports[0].traversal, "");
    EXPECT_EQ(statistics.viewports[0].stepsPerRay, 0.0);
    EXPECT_EQ(vulkan::validationMessages(), 0u);
}

} // namespace
} // namespace metamarch::viewer
