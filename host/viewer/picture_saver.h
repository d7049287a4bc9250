// SPDX-License-Identifier: MIT
// Pictures from the window to files, by the code that writes those of `metamarch render`.
#pragma once
#include "metamarch/viewer/progressive_image.h"
#include "metamarch/viewer/viewer_state.h"
#include "metamarch/vulkan/device.h"

#include <string>

namespace metamarch::viewer {

class PictureSaver {
  public:
    PictureSaver(std::string software, const vulkan::Device& device);

    // ".png": what the left side shows, at the image's own size; ".exr": the path tracer's film with all its
    // channels. Into the current folder, under the scene's name and the next free number. Returns a line for
    // the user. Throws Error(outputNotWritable), and Error(invalidArgument) for an EXR of a view and a
    // picture with empty parts.
    std::string save(const ProgressiveImage& progressive, const RenderRequest& request,
                     const std::string& traversal, const ViewerState& state, const std::string& ending) const;

  private:
    std::string software;
    const vulkan::Device& device;
};

} // namespace metamarch::viewer
