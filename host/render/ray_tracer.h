// Traces rays given one by one: the kernel `rays`, for tests and benchmarks.
#pragma once
#include "render/scene_buffers.h"
#include "render/work_size.h"
#include "shared/ray_query.h"
#include "vulkan/submission.h"

#include <span>
#include <string>
#include <vector>

namespace metamarch::render {

class RayTracer {
  public:
    RayTracer(const vulkan::Device& device, const SceneBuffers& scene, const std::string& traversal,
              bool anyHit);

    // One result per ray, in their order. Throws Error(outOfMemory) where the driver cuts a traversal short.
    std::vector<RayResult> trace(std::span<const RayQuery> rays);

    // What the last call of trace() took on the device, without transfers and without its first submission of
    // one workgroup, which may compile.
    double deviceSeconds() const { return seconds; }

  private:
    std::vector<RayResult> traceBatch(std::span<const RayQuery> rays);

    const vulkan::Device& device;
    vulkan::ComputePipeline pipeline;
    vulkan::Submission submission;
    WorkSize work;
    double seconds = 0.0;
};

} // namespace metamarch::render
