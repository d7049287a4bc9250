// SPDX-License-Identifier: MIT
#include "metamarch/viewer/viewport.h"

#include "metamarch/shared/tile_order.h"

#include <algorithm>
#include <array>

namespace metamarch::viewer {
namespace {

// The sizes that a pixel of the coarse picture may have, in pixels of the fine one.
constexpr std::array<std::uint32_t, 7> kCoarseness = {2, 3, 4, 6, 8, 12, 16};
constexpr std::uint32_t kFirstCoarseness = 8; // until the device's speed is known

// Device time of the film's first sample, after which its tiles are shown over the preview one by one.
constexpr double kLongestPreview = 3.0;

constexpr std::uint64_t kLeastFilmBytes = std::uint64_t{1} << 20; // 9,000 pixels: something to see

// A viewport has two sums of this size, and less than one for the filter, the coarse picture and the sharp
// preview; a split has two viewports. Two parts of the free memory are left to the driver and to other
// programs.
constexpr std::uint64_t kParts = 8;

glm::uvec2 divided(const glm::uvec2 size, const std::uint32_t by) { return (size + by - 1u) / by; }

// Returns the window's size, or, if the film would be too large, that size divided by a whole number.
glm::uvec2 fittingSize(const vulkan::Device& device, const glm::uvec2 window) {
    const std::uint64_t most = std::max(device.freeMemory() / kParts, kLeastFilmBytes);
    std::uint32_t by = 1;
    glm::uvec2 size = window;
    const auto bytes = [](const glm::uvec2 s) {
        const glm::uvec2 tiles = divided(s, kTileSide);
        return std::uint64_t{tiles.x} * tiles.y * kTilePixels * sizeof(FilmPixel);
    };
    while (bytes(size) > most) {
        size = divided(window, ++by);
    }
    return size;
}

} // namespace

Viewport::Viewport(const vulkan::Device& device, const render::DeviceScene& scene,
                   const std::string& traversal, const glm::uvec2 size, const ShaderOverrides& shaders,
                   const Backdrop& usedBackdrop)
    : name(traversal), fineSize(fittingSize(device, size)),
      coarse(device, scene, traversal, divided(fineSize, kCoarseness.front()), shaders),
      sharp(device, scene, traversal, fineSize, shaders), fine(device, scene, traversal, fineSize, shaders),
      presenting(device, PresentKernel::Behind::nothing),
      presentingOver(device, PresentKernel::Behind::backdrop), backdrop(usedBackdrop) {}

void Viewport::start(const RenderRequest& request, const double seconds) {
    const double pixels = static_cast<double>(fineSize.x) * fineSize.y;
    const auto* const fitting = std::ranges::find_if(
        kCoarseness, [&](const std::uint32_t by) { return pixels / (by * by) * secondsPerPixel <= seconds; });
    const std::uint32_t by = secondsPerPixel == 0.0             ? kFirstCoarseness
                             : fitting == std::end(kCoarseness) ? kCoarseness.back()
                                                                : *fitting;
    RenderRequest quick = request;
    quick.endSample = 1;
    hasBackdrop = !request.view;
    hasPreview = request.hasPreview && !request.view;
    if (hasPreview) {
        quick.view = kViewHeadlight;
        sharp.start(quick, fineSize);
    }
    coarse.start(quick, divided(fineSize, by));
    fine.start(request, fineSize);
}

void Viewport::setTone(const ToneMapping& toneMapping) {
    coarse.setTone(toneMapping);
    fine.setTone(toneMapping);
}

bool Viewport::advance(const double seconds) {
    if (coarse.isWhole()) {
        return (hasPreview && sharp.advance(seconds)) || fine.advance(seconds);
    }
    coarse.advance(seconds);
    if (coarse.isWhole() && coarse.seconds() > 0.0) {
        secondsPerPixel = coarse.seconds() / (static_cast<double>(coarse.size().x) * coarse.size().y);
    }
    return true;
}

bool Viewport::isBeforeKernel() const {
    if (!coarse.isWhole()) {
        return coarse.isBeforeKernel();
    }
    return (!hasPreview || sharp.isWhole()) && fine.isBeforeKernel();
}

void Viewport::record(vulkan::Commands& commands, const Screen& screen, const std::uint32_t first,
                      const std::uint32_t end) {
    coarse.record(commands);
    sharp.record(commands);
    fine.record(commands);
    const bool isSharp = hasPreview && sharp.isWhole();
    // Tiles of noise between tiles of the preview would be worse than either, but a slow film shows that it
    // comes.
    const bool isFineShown =
        fine.hasPicture() && (!hasPreview || fine.isReady() || fine.seconds() > kLongestPreview);
    const ProgressiveImage& lower = isSharp ? sharp : coarse;
    const ProgressiveImage& upper = isFineShown ? fine : hasPreview ? sharp : lower;
    if (first >= end || !lower.hasPicture()) {
        return;
    }
    const glm::uvec2 texels = hasBackdrop ? backdrop.size() : glm::uvec2(0);
    PresentKernel& kernel = texels.x > 0 ? presentingOver : presenting;
    kernel.record(commands, screen, first, end, {upper.picture(), upper.size()},
                  {lower.picture(), lower.size()}, {backdrop.texels(), texels});
}

} // namespace metamarch::viewer
