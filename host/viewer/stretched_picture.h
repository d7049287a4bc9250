// SPDX-License-Identifier: MIT
// Fills the screen with an older picture of it, stretched if the sizes differ.
#pragma once
#include "metamarch/viewer/present_kernel.h"

namespace metamarch::viewer {

class StretchedPicture {
  public:
    explicit StretchedPicture(const vulkan::Device& device)
        : stretching_(device, PresentKernel::Behind::nothing) {}

    // `picture` has the screen's order of channels. Call it at most once per frame.
    void record(vulkan::Commands& commands, const DevicePicture& picture, const Screen& screen) {
        // Both have the same order in memory, so no bytes are exchanged.
        Screen inThatOrder = screen;
        inThatOrder.isBlueFirst = false;
        stretching_.record(commands, inThatOrder, 0, screen.size.x, picture, picture,
                           {picture.pixels, {0, 0}});
    }

  private:
    PresentKernel stretching_;
};

} // namespace metamarch::viewer
