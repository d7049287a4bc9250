// SPDX-License-Identifier: MIT
#include "metamarch/render/ray_tracer.h"

#include "metamarch/render/cut_short.h"

namespace metamarch::render {

RayTracer::RayTracer(const vulkan::Device& usedDevice, const SceneBuffers& scene,
                     const std::string& usedTraversal, const bool anyHit)
    : device(usedDevice), traversal(usedTraversal),
      batches(usedDevice, scene.makePipeline(usedDevice, "rays", usedTraversal,
                                             {.storageBindings = {kBindOutput},
                                              .texelBindings = {{kBindInput, VK_FORMAT_R32G32B32A32_UINT}},
                                              .pushConstantSize = sizeof(RaysPush),
                                              .specialization = {{kSpecAnyHit, anyHit ? 1u : 0u}}})) {}

std::vector<RayResult> RayTracer::trace(const std::span<const RayQuery> rays) {
    std::vector<RayResult> results = batches.run(rays, {});
    for (const RayResult& result : results) {
        refuseCutShort(result.steps, device, traversal);
    }
    return results;
}

} // namespace metamarch::render
