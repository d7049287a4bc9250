// SPDX-License-Identifier: MIT
// What one traversal shows of the scene at the window's size: at once and coarse, then fine.
#pragma once
#include "metamarch/viewer/presenter.h"
#include "metamarch/viewer/progressive_image.h"

#include <cstdint>
#include <string>

namespace metamarch::viewer {

class Viewport {
  public:
    // `size` of the window, in pixels.
    Viewport(const vulkan::Device& device, const render::DeviceScene& scene, const std::string& traversal,
             glm::uvec2 size, const ShaderOverrides& shaders);

    // From now on it shows this. The coarse picture takes about `seconds` of the device.
    void start(const RenderRequest& request, double seconds);
    void setTone(const ToneMapping& toneMapping);

    // One submission of about `seconds`; false where nothing is left to do.
    bool advance(double seconds);

    // Every pixel of the window shows something of the request.
    bool isWhole() const { return coarse.isWhole(); }

    // Writes the columns [first, end) of the screen, if any. Once in a frame.
    void record(vulkan::Commands& commands, const Screen& screen, std::uint32_t first, std::uint32_t end);

    const std::string& traversal() const { return name; }
    const ProgressiveImage& fineImage() const { return fine; }
    const ProgressiveImage& coarseImage() const { return coarse; }

  private:
    vulkan::ComputePipeline& presenting();

    const vulkan::Device& device;
    std::string name;
    glm::uvec2 fineSize;
    ProgressiveImage coarse;
    ProgressiveImage fine;
    // Of the path tracer's pictures, and of the views', from their first use on.
    std::optional<vulkan::ComputePipeline> presentPath;
    std::optional<vulkan::ComputePipeline> presentView;
    bool isView = false;
    double secondsPerPixel = 0.0; // of the coarse picture, when it was last whole; 0: never yet
};

} // namespace metamarch::viewer
