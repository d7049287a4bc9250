// SPDX-License-Identifier: MIT
// Traces single rays with the kernel `rays`, on a Vulkan device or on the processor.
#pragma once
#include "metamarch/processor/processor_kernels.h"
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

// Returns the closest hit of each ray, in the order of `rays`. `kernel` is one of rayKernels(). Throws
// Error(outOfMemory) if an array of the structure has more than 4 GiB.
std::vector<RayResult> traceOnCpu(const AccelerationStructure& structure, std::span<const RayQuery> rays,
                                  Kernel kernel = rayKernels().front().run);

} // namespace metamarch::render
