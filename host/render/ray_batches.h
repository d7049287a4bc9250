// SPDX-License-Identifier: MIT
// Runs a kernel of one invocation per ray over any number of rays.
#pragma once
#include "metamarch/render/work_size.h"
#include "metamarch/shared/ray_query.h"
#include "metamarch/vulkan/submission.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::render {

// Rays go to the device in batches within every device's limits and are traced in short submissions.
class RayBatches {
  public:
    // `kernelPipeline` has bindings kBindInput for the rays and kBindOutput for the results, and RaysPush.
    RayBatches(const vulkan::Device& device, vulkan::ComputePipeline kernelPipeline);

    // One result per ray, in their order. A kernel that is told the hits has a binding kBindKnownRecords for
    // `knownRecords`, one per ray; for others they are empty.
    std::vector<RayResult> run(std::span<const RayQuery> rays, std::span<const std::uint32_t> knownRecords);

    // What the last run() took on the device, without transfers and without its first submission of one
    // workgroup, which may compile.
    double deviceSeconds() const { return seconds; }

  private:
    std::vector<RayResult> runBatch(std::span<const RayQuery> rays,
                                    std::span<const std::uint32_t> knownRecords);

    const vulkan::Device& device;
    vulkan::ComputePipeline pipeline;
    vulkan::Submission submission;
    WorkSize work;
    double seconds = 0.0;
};

} // namespace metamarch::render
