// SPDX-License-Identifier: MIT
#include "metamarch/viewer/stretched_picture.h"

#include "metamarch/render/kernel.h"
#include "metamarch/shared/backdrop.h"
#include "metamarch/shared/screen.h"

namespace metamarch::viewer {

void StretchedPicture::record(vulkan::Commands& commands, const vulkan::Buffer& pixels, const glm::uvec2 size,
                              const Screen& screen) {
    if (!stretching_) {
        stretching_ =
            render::makeKernel(device_, "present",
                               {.storageBindings = {kBindInput, kBindCoarse, kBindBackdrop, kBindOutput},
                                .pushConstantSize = sizeof(PresentPush)});
    }
    stretching_->bind(kBindInput, pixels);
    stretching_->bind(kBindCoarse, pixels);
    stretching_->bind(kBindBackdrop, pixels); // is not read
    stretching_->bind(kBindOutput, screen.pixels);
    // Both have the same order in memory, so no bytes are exchanged.
    commands.dispatch(*stretching_, {(screen.size.x + kScreenTile - 1) / kScreenTile, screen.size.y, 1},
                      PresentPush{screen.size.x, screen.size.y, 0, screen.size.x, size.x, size.y, size.x,
                                  size.y, 0u, 0u, 0u});
}

} // namespace metamarch::viewer
