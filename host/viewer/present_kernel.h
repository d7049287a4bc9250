// SPDX-License-Identifier: MIT
// The kernel `present`, which writes pictures of any size to the screen.
#pragma once
#include "metamarch/viewer/screen.h"
#include "metamarch/vulkan/compute_pipeline.h"
#include "metamarch/vulkan/submission.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace metamarch::viewer {

// Packed pixels, or the texels of a backdrop, in rows from the top.
struct DevicePicture {
    const vulkan::Buffer& pixels;
    glm::uvec2 size;
};

class PresentKernel {
  public:
    enum class Behind { nothing, backdrop };
    PresentKernel(const vulkan::Device& device, Behind behind);

    // Writes the columns [first, end) of the screen: `upper`, where it is empty `lower`, and behind both the
    // backdrop, which is not read if the kernel has none. Call it at most once per frame.
    void record(vulkan::Commands& commands, const Screen& screen, std::uint32_t first, std::uint32_t end,
                const DevicePicture& upper, const DevicePicture& lower, const DevicePicture& backdrop);

  private:
    vulkan::ComputePipeline pipeline_;
};

} // namespace metamarch::viewer
