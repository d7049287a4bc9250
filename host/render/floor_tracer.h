// SPDX-License-Identifier: MIT
// Traces rays whose hits are known in advance, with the kernel `floor`: the least that tracing costs a
// device.
#pragma once
#include "metamarch/render/ray_batches.h"
#include "metamarch/render/scene_buffers.h"

#include <span>
#include <vector>

namespace metamarch::render {

class FloorTracer {
  public:
    FloorTracer(const vulkan::Device& device, const SceneBuffers& scene);

    // Returns one result per ray, in the order of `rays`. `recordIndices` holds, for each ray, the index of
    // the record that it hits in AccelerationStructure::triangles, or kNoRecord for a miss. A miss tests no
    // triangle.
    std::vector<RayResult> trace(std::span<const RayQuery> rays,
                                 std::span<const std::uint32_t> recordIndices);

    // Returns RayBatches::deviceSeconds of the last call of trace().
    double deviceSeconds() const { return batches.deviceSeconds(); }

  private:
    RayBatches batches;
};

} // namespace metamarch::render
