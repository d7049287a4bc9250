// SPDX-License-Identifier: MIT
// Saves the window's pictures to files, with the same code as `metamarch render`.
#pragma once
#include "metamarch/image/denoiser.h"
#include "metamarch/viewer/backdrop.h"
#include "metamarch/viewer/progressive_image.h"
#include "metamarch/viewer/viewer_state.h"
#include "metamarch/vulkan/device.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace metamarch::viewer {

class PictureSaver {
  public:
    PictureSaver(std::string software, const vulkan::Device& device);

    // Writes a file into the current folder; its name is the scene's name with the next free number. An
    // `ending` of ".png" saves what the left viewport shows, at the size of the progressive image; ".exr"
    // saves the path tracer's film with all its channels. A denoiser removes the noise of both. What is
    // behind the scene is in the PNG, but for BackdropChoice::Kind::off; in a film there is nothing. Returns
    // a line for the user. Throws Error(outputNotWritable), and Error(invalidArgument) for an EXR of a view
    // or for a picture that still has empty parts.
    std::string save(const ProgressiveImage& progressive, const RenderRequest& request,
                     const std::string& traversal, const ViewerState& state, const std::string& ending,
                     const Denoiser* denoiser, const Backdrop& backdrop) const;

    // Writes a PNG of the window's pixels: red, green, blue from the low byte on, rows from the top. Its name
    // is `stem` with the next free number. Returns the full path. Throws Error(outputNotWritable).
    std::string saveWindow(const std::vector<std::uint32_t>& pixels, glm::uvec2 size,
                           const std::string& stem) const;

  private:
    std::string software;
    const vulkan::Device& device;
};

} // namespace metamarch::viewer
