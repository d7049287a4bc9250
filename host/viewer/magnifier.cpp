// SPDX-License-Identifier: MIT
#include "metamarch/viewer/magnifier.h"

#include "metamarch/render/kernel.h"
#include "metamarch/shared/screen.h"

namespace metamarch::viewer {

void Magnifier::make(const glm::uvec2 size) {
    if (!kernel_) {
        kernel_ = render::makeKernel(
            device_, "magnify",
            {.storageBindings = {kBindInput, kBindOutput}, .pushConstantSize = sizeof(MagnifyPush)});
    }
    shown_.reset();
    shown_.emplace(device_, vulkan::BufferUse::storage,
                   std::uint64_t{size.x} * size.y * sizeof(std::uint32_t), "magnified picture");
    size_ = size;
}

const vulkan::Buffer& Magnifier::record(vulkan::Commands& commands, const Screen& screen,
                                        const PixelZoom& zoom) {
    kernel_->bind(kBindInput, screen.pixels);
    kernel_->bind(kBindOutput, *shown_);
    commands.dispatch(*kernel_, {(screen.size.x + kScreenTile - 1) / kScreenTile, screen.size.y, 1},
                      MagnifyPush{screen.size.x, zoom.scale(), zoom.skipped().x, zoom.skipped().y});
    return *shown_;
}

} // namespace metamarch::viewer
