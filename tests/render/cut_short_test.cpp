// SPDX-License-Identifier: MIT
// A driver that ends loops early (Mesa's llvmpipe does, after 65,535 turns) must not lose hits without an
// error.
#include "fixtures/ray_sets.h"
#include "fixtures/shapes.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/error/error.h"
#include "metamarch/reference/trace.h"
#include "metamarch/render/ray_tracer.h"

#include <gtest/gtest.h>

namespace metamarch::tests {
namespace {

TEST(CutShort, isRefusedOrRight) {
    Scene scene;
    addSphere(scene, glm::vec3(0.0f), 1.0f, 400, 100); // 79,200 triangles
    const AccelerationStructure structure =
        buildAccelerationStructure(scene, {{}, {}, 0u}); // all in one leaf
    const render::SceneBuffers buffers(vulkan::testDevice(), structure, makeShadingData(scene));
    const std::vector<RayQuery> rays = trickyRays(scene, structure, 256, 3);
    std::vector<RayResult> results;
    try {
        results = vulkan::skipUnlessTexelsSuffice([&] {
            return render::RayTracer(vulkan::testDevice(), buffers, "meta_table", false).trace(rays);
        });
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::outOfMemory);
        EXPECT_NE(std::string(error.what()).find("65535"), std::string::npos) << error.what();
        return;
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = makeRay(structure.lattice, rays[i].origin, rays[i].tMin, rays[i].dir, rays[i].tMax);
        EXPECT_EQ(results[i].triangleId, traceMetaTable(structure, ray, HitQuery::closest).hit.triangleId);
    }
}

} // namespace
} // namespace metamarch::tests
