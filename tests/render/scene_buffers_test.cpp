// SPDX-License-Identifier: MIT
// Scenes that are larger than one buffer of the device. Small scenes with a small limit replace large ones.
#include "fixtures/expect_error.h"
#include "fixtures/ray_sets.h"
#include "fixtures/shapes.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/render/ray_tracer.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/shaders/shader_library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace metamarch::tests {
namespace {

class SceneBuffers : public testing::Test {
  protected:
    static void skipWhereStorageBuffersFail() {
        if (vulkan::testDevice().report().failsWithStorageBuffers) {
            vulkan::skipTest("the driver changes what a lane has loaded from a storage buffer in a loop "
                             "that it has left");
        }
    }

    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    std::uint64_t records() const { return structure.triangles.size(); }

    // Returns the smallest limit with which `chunks` buffers suffice for the records.
    std::uint64_t limitFor(const std::uint64_t chunks) const {
        return (records() + chunks - 1) / chunks * sizeof(TriangleRecord);
    }

    render::SceneBuffers buffersUnder(const std::uint64_t limit) const {
        return {vulkan::testDevice(), treeOnly, shading, limit};
    }

    // The scene has few cells and leaves, so that the tree's triangle records are by far the largest buffer.
    const Scene scene = triangleSoup(4000, 8);
    const AccelerationStructure structure = buildAccelerationStructure(scene, {{}, 4096u, 6u});
    // What the march reads of leaves is larger than a small part of the records, so it is left out.
    const AccelerationStructure treeOnly = [this] {
        AccelerationStructure tree = structure;
        tree.table.recordWords.resize(4);
        tree.table.leafRecords.resize(4);
        tree.table.triangles = tree.triangles;
        return tree;
    }();
    const ShadingData shading = makeShadingData(scene);
};

// One traversal is enough, because only one function, which all traversals call, knows the chunks.
TEST_F(SceneBuffers, giveTheSameHitsInChunks) {
    skipWhereStorageBuffersFail();
    const std::vector<RayQuery> rays = trickyRays(scene, structure, 20000, 9);
    const auto trace = [&](const render::SceneBuffers& buffers, const bool anyHit) {
        return render::RayTracer(vulkan::testDevice(), buffers, "kd_stack", anyHit).trace(rays);
    };
    const render::SceneBuffers whole(vulkan::testDevice(), treeOnly, shading);
    for (const bool anyHit : {false, true}) {
        const std::vector<RayResult> expected = trace(whole, anyHit);
        const auto hits = std::count_if(expected.begin(), expected.end(), [](const RayResult& result) {
            return result.triangleId != kNoTriangle;
        });
        ASSERT_GT(hits, 1000);
        for (const std::uint32_t chunks : {2u, 3u, kTriangleChunks}) {
            SCOPED_TRACE(chunks);
            ASSERT_EQ(render::chunkTriangles(records(), limitFor(chunks)).count, chunks);
            const std::vector<RayResult> results = trace(buffersUnder(limitFor(chunks)), anyHit);
            EXPECT_TRUE(
                std::ranges::equal(std::as_bytes(std::span(results)), std::as_bytes(std::span(expected))));
        }
    }
}

TEST_F(SceneBuffers, holdEachRecordOnce) {
    const render::SceneBuffers whole(vulkan::testDevice(), treeOnly, shading);
    EXPECT_GT(whole.bytes(), records() * sizeof(TriangleRecord));
    EXPECT_EQ(buffersUnder(limitFor(kTriangleChunks)).bytes(), whole.bytes());
}

TEST_F(SceneBuffers, refuseTooManyChunks) {
    expectError(ErrorKind::outOfMemory, "maxStorageBufferRange",
                [&] { buffersUnder(limitFor(kTriangleChunks + 1)); });
}

TEST_F(SceneBuffers, refuseATableOverTheLimit) {
    AccelerationStructure large = structure;
    const std::uint64_t limit = limitFor(1);
    large.table.recordWords.resize(limit / sizeof(std::uint32_t) + 1);
    const auto load = [&] { render::SceneBuffers(vulkan::testDevice(), large, shading, limit); };
    expectError(ErrorKind::outOfMemory, "meta table", load);
    expectError(ErrorKind::outOfMemory, "maxStorageBufferRange", load);
    expectError(ErrorKind::outOfMemory, "choose a smaller tree depth or fewer cells", load);
}

TEST_F(SceneBuffers, refuseLeafRecordsOverTheLimit) {
    AccelerationStructure large = structure;
    const std::uint64_t limit = limitFor(1);
    large.table.leafRecords.resize(limit / sizeof(std::uint32_t) + 1);
    expectError(ErrorKind::outOfMemory, "array of leaf records",
                [&] { render::SceneBuffers(vulkan::testDevice(), large, shading, limit); });
}

TEST(Traversals, areRefusedByNameWhereADeviceCannotRunThem) {
    vulkan::DeviceReport report = vulkan::testDevice().report();
    report.missingForRayQuery = {"VK_KHR_ray_query", "rayQuery"};
    for (const std::string_view traversal : traversals()) {
        const bool wantsIt = traversal == "ray_query";
        EXPECT_EQ(render::missingFor(report, traversal).empty(), !wantsIt) << traversal;
        if (wantsIt) {
            expectError(ErrorKind::noDevice, "lacks VK_KHR_ray_query, rayQuery",
                        [&] { render::requireTraversal(report, traversal); });
        }
    }
    report.missingForRayQuery.clear();
    EXPECT_TRUE(render::missingFor(report, "ray_query").empty());
}

// Every shader is built for storage buffers and for texel buffers; both builds must give the same hits.
TEST_F(SceneBuffers, giveTheSameHitsFromEitherMemory) {
    skipWhereStorageBuffersFail();
    const std::vector<RayQuery> rays = trickyRays(scene, structure, 2000, 11);
    const vulkan::Device& device = vulkan::testDevice();
    const render::SceneBuffers fast(device, structure, shading);
    const render::SceneBuffers storage(device, structure, shading, device.report().maxStorageBufferRange);
    for (const std::string_view name : traversals()) {
        if (!render::missingFor(device.report(), name).empty()) {
            continue;
        }
        SCOPED_TRACE(name);
        const std::vector<RayResult> expected =
            render::RayTracer(device, fast, std::string(name), false).trace(rays);
        const std::vector<RayResult> found =
            render::RayTracer(device, storage, std::string(name), false).trace(rays);
        EXPECT_EQ(std::memcmp(found.data(), expected.data(), rays.size() * sizeof(RayResult)), 0);
    }
}

TEST_F(SceneBuffers, refuseAnUnknownTraversal) {
    const render::SceneBuffers buffers(vulkan::testDevice(), structure, shading);
    for (const std::string_view traversal : traversals()) {
        expectError(ErrorKind::invalidArgument, std::string(traversal),
                    [&] { render::RayTracer(vulkan::testDevice(), buffers, "no_such", false); });
    }
}

} // namespace
} // namespace metamarch::tests
