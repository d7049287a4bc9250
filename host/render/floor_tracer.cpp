// SPDX-License-Identifier: MIT
#include "metamarch/render/floor_tracer.h"

namespace metamarch::render {

FloorTracer::FloorTracer(const vulkan::Device& device, const SceneBuffers& scene)
    : batches(device, scene.makePipeline(device, "floor", "",
                                         {.storageBindings = {kBindOutput},
                                          .texelBindings = {{kBindInput, VK_FORMAT_R32G32B32A32_UINT},
                                                            {kBindKnownRecords, VK_FORMAT_R32_UINT}},
                                          .pushConstantSize = sizeof(RaysPush)})) {}

std::vector<RayResult> FloorTracer::trace(const std::span<const RayQuery> rays,
                                          const std::span<const std::uint32_t> recordIndices) {
    return batches.run(rays, recordIndices);
}

} // namespace metamarch::render
