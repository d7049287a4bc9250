// SPDX-License-Identifier: MIT
// Shows the screen's pixels as PixelZoom asks, with the kernel `magnify`.
#pragma once
#include "metamarch/viewer/pixel_zoom.h"
#include "metamarch/viewer/screen.h"
#include "metamarch/vulkan/compute_pipeline.h"
#include "metamarch/vulkan/submission.h"

#include <optional>

namespace metamarch::viewer {

class Magnifier {
  public:
    explicit Magnifier(const vulkan::Device& usedDevice) : device_(usedDevice) {}

    // Returns true if a screen of `size` can be magnified without further memory.
    bool isReady(const glm::uvec2 size) const { return shown_ && size_ == size; }
    // Makes that so. No frame may be drawn meanwhile. Throws Error(outOfMemory).
    void make(glm::uvec2 size);

    // Returns the pixels to show in place of the screen's. Call it at most once per frame, and only if the
    // magnifier is ready for the screen.
    const vulkan::Buffer& record(vulkan::Commands& commands, const Screen& screen, const PixelZoom& zoom);

  private:
    const vulkan::Device& device_;
    std::optional<vulkan::ComputePipeline> kernel_;
    std::optional<vulkan::Buffer> shown_;
    glm::uvec2 size_{0};
};

} // namespace metamarch::viewer
