// SPDX-License-Identifier: MIT
#include "metamarch/viewer/kept_pictures.h"

#include "metamarch/shared/screen.h"
#include "metamarch/vulkan/transfer.h"

#include <utility>

namespace metamarch::viewer {

namespace {

vulkan::Buffer pixelsOf(const vulkan::Device& device, const glm::uvec2 size) {
    return {device, vulkan::BufferUse::storage, std::uint64_t{size.x} * size.y * sizeof(std::uint32_t),
            "kept picture"};
}

} // namespace

void KeptPictures::keep(const Shown slot, const glm::uvec2 size) {
    kept_[indexOf(slot)].next = {.pixels = pixelsOf(device_, size), .size = size};
}

void KeptPictures::follow(const glm::uvec2 size) {
    for (Kept& kept : kept_) {
        if (kept.next.pixels && kept.next.size != size) { // a frame was left out, and the window has changed
            kept.next = {};
            kept.next = {.pixels = pixelsOf(device_, size), .size = size};
        }
    }
}

void KeptPictures::paint(vulkan::Commands& commands, const Screen& screen, const Shown shown) {
    // A slot that is to be replaced takes what the screen has, and not its own picture of before.
    if (shown != Shown::present && has(shown) && !kept_[indexOf(shown)].next.pixels) {
        const OnDevice& picture = kept_[indexOf(shown)].picture;
        stretched_.record(commands, {*picture.pixels, picture.size}, screen);
    }
    for (Kept& kept : kept_) {
        kept.old = {}; // the frame that used it has been drawn
        if (!kept.next.pixels) {
            continue;
        }
        commands.copy(screen.pixels, 0, *kept.next.pixels, 0, kept.next.pixels->size());
        kept.next.isBlueFirst = screen.isBlueFirst;
        kept.old = std::exchange(kept.picture, std::exchange(kept.next, {}));
    }
}

KeptPictures::Picture KeptPictures::picture(const Shown slot) const {
    const OnDevice& kept = kept_[indexOf(slot)].picture;
    Picture result{vulkan::download<std::uint32_t>(device_, *kept.pixels), kept.size};
    if (kept.isBlueFirst) {
        for (std::uint32_t& pixel : result.pixels) {
            pixel = withBlueFirst(pixel);
        }
    }
    return result;
}

} // namespace metamarch::viewer
