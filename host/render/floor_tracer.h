// SPDX-License-Identifier: MIT
// Rays whose hits are known in advance: the kernel `floor`, what tracing costs a device at least.
#pragma once
#include "metamarch/render/ray_batches.h"
#include "metamarch/render/scene_buffers.h"

#include <span>
#include <vector>

namespace metamarch::render {

class FloorTracer {
  public:
    FloorTracer(const vulkan::Device& device, const SceneBuffers& scene);

    // One result per ray, in their order. `recordIndices` names each ray's hit among the records of the
    // AccelerationStructure; kNoRecord for a miss, for which nothing is tested.
    std::vector<RayResult> trace(std::span<const RayQuery> rays,
                                 std::span<const std::uint32_t> recordIndices);

    // RayBatches::deviceSeconds of the last call of trace().
    double deviceSeconds() const { return batches.deviceSeconds(); }

  private:
    RayBatches batches;
};

} // namespace metamarch::render
