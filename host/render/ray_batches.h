// SPDX-License-Identifier: MIT
// Runs a kernel that has one invocation per ray, over any number of rays.
#pragma once
#include "metamarch/render/work_size.h"
#include "metamarch/shared/ray_query.h"
#include "metamarch/vulkan/submission.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::render {

// Uploads the rays in batches that are within every device's limits, and traces them in short submissions.
class RayBatches {
  public:
    // `kernelPipeline` must have the bindings kBindInput (rays) and kBindOutput (results), and the push
    // constants RaysPush.
    RayBatches(const vulkan::Device& device, vulkan::ComputePipeline kernelPipeline);

    // Returns one result per ray, in the order of `rays`. `knownRecords` holds one record index per ray for a
    // kernel with the binding kBindKnownRecords; for other kernels it is empty.
    std::vector<RayResult> run(std::span<const RayQuery> rays, std::span<const std::uint32_t> knownRecords);

    // Returns the time that the last run() took on the device, without transfers. The very first submission,
    // of one workgroup, is left out as well, because the driver may compile the kernel in it.
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
