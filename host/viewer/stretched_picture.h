// SPDX-License-Identifier: MIT
// Fills the screen with an older picture of it, stretched if the sizes differ, with the kernel `present`.
#pragma once
#include "metamarch/viewer/screen.h"
#include "metamarch/vulkan/compute_pipeline.h"
#include "metamarch/vulkan/submission.h"

#include <optional>

namespace metamarch::viewer {

class StretchedPicture {
  public:
    explicit StretchedPicture(const vulkan::Device& usedDevice) : device_(usedDevice) {}

    // `pixels` are rows from the top, in the screen's order of channels. Call it at most once per frame.
    void record(vulkan::Commands& commands, const vulkan::Buffer& pixels, glm::uvec2 size,
                const Screen& screen);

  private:
    const vulkan::Device& device_;
    std::optional<vulkan::ComputePipeline> stretching_; // created on first use
};

} // namespace metamarch::viewer
