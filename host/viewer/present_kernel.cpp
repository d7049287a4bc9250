// SPDX-License-Identifier: MIT
#include "metamarch/viewer/present_kernel.h"

#include "metamarch/render/kernel.h"
#include "metamarch/shared/backdrop.h"
#include "metamarch/shared/screen.h"

namespace metamarch::viewer {

PresentKernel::PresentKernel(const vulkan::Device& device, const Behind behind)
    : pipeline_(
          render::makeKernel(device, "present",
                             {.storageBindings = {kBindInput, kBindCoarse, kBindBackdrop, kBindOutput},
                              .pushConstantSize = sizeof(PresentPush),
                              .specialization = {{kSpecBackdrop, behind == Behind::backdrop ? 1u : 0u}}})) {}

void PresentKernel::record(vulkan::Commands& commands, const Screen& screen, const std::uint32_t first,
                           const std::uint32_t end, const DevicePicture& upper, const DevicePicture& lower,
                           const DevicePicture& backdrop) {
    pipeline_.bind(kBindInput, upper.pixels);
    pipeline_.bind(kBindCoarse, lower.pixels);
    pipeline_.bind(kBindBackdrop, backdrop.pixels);
    pipeline_.bind(kBindOutput, screen.pixels);
    commands.dispatch(pipeline_, {(end - first + kScreenTile - 1) / kScreenTile, screen.size.y, 1},
                      PresentPush{screen.size.x, screen.size.y, first, end, upper.size.x, upper.size.y,
                                  lower.size.x, lower.size.y, screen.isBlueFirst ? 1u : 0u, backdrop.size.x,
                                  backdrop.size.y});
}

} // namespace metamarch::viewer
