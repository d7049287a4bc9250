// SPDX-License-Identifier: MIT
// Traces single rays with the kernel `rays`, for tests and benchmarks.
#pragma once
#include "metamarch/render/ray_batches.h"
#include "metamarch/render/scene_buffers.h"

#include <span>
#include <string>
#include <vector>

namespace metamarch::render {

class RayTracer {
  public:
    RayTracer(const vulkan::Device& device, const SceneBuffers& scene, const std::string& traversal,
              bool anyHit);

    // Returns one result per ray, in the order of `rays`. Throws Error(outOfMemory) if the driver cuts a
    // traversal short.
    std::vector<RayResult> trace(std::span<const RayQuery> rays);

    // Returns RayBatches::deviceSeconds of the last call of trace().
    double deviceSeconds() const { return batches.deviceSeconds(); }

  private:
    const vulkan::Device& device;
    std::string traversal;
    RayBatches batches;
};

} // namespace metamarch::render
