// SPDX-License-Identifier: MIT
#include "metamarch/viewer/swapchain.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace metamarch::viewer {
namespace {

vk::SurfaceFormatKHR chooseFormat(const vulkan::Device& device, const vk::raii::SurfaceKHR& surface) {
    for (const vk::SurfaceFormatKHR& offered : device.physicalDevice().getSurfaceFormatsKHR(*surface)) {
        const bool isKnown =
            offered.format == vk::Format::eB8G8R8A8Unorm || offered.format == vk::Format::eR8G8B8A8Unorm;
        if (isKnown && offered.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear) {
            return offered;
        }
    }
    throw Error(ErrorKind::noDevice,
                fmt::format("{}: this window takes no 8-bit sRGB pictures", device.name()));
}

// Prefers a window that shows nothing behind it.
vk::CompositeAlphaFlagBitsKHR chooseAlpha(const vk::SurfaceCapabilitiesKHR& limits) {
    using Alpha = vk::CompositeAlphaFlagBitsKHR;
    for (const Alpha offered :
         {Alpha::eOpaque, Alpha::eInherit, Alpha::ePreMultiplied, Alpha::ePostMultiplied}) {
        if (limits.supportedCompositeAlpha & offered) {
            return offered;
        }
    }
    return Alpha::eOpaque;
}

// Prefers mailbox: the program then never waits for the screen, and the screen never shows half a picture.
vk::PresentModeKHR chooseMode(const vulkan::Device& device, const vk::raii::SurfaceKHR& surface) {
    const auto offered = device.physicalDevice().getSurfacePresentModesKHR(*surface);
    const bool hasMailbox = std::ranges::find(offered, vk::PresentModeKHR::eMailbox) != offered.end();
    return hasMailbox ? vk::PresentModeKHR::eMailbox : vk::PresentModeKHR::eFifo;
}

} // namespace

Swapchain::Swapchain(const vulkan::Device& device, const vk::raii::SurfaceKHR& surface, const glm::uvec2 size,
                     const Swapchain* const previous) {
    const std::uint32_t family = device.report().computeQueueFamily.value();
    const vk::SurfaceCapabilitiesKHR limits = device.physicalDevice().getSurfaceCapabilitiesKHR(*surface);
    const vk::ImageUsageFlags usage =
        vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eColorAttachment;
    if (!device.physicalDevice().getSurfaceSupportKHR(family, *surface) ||
        (limits.supportedUsageFlags & usage) != usage) {
        throw Error(ErrorKind::noDevice,
                    fmt::format("{} cannot present to this window; choose another device", device.name()),
                    {"device"});
    }
    const vk::ImageUsageFlags copying = limits.supportedUsageFlags & vk::ImageUsageFlagBits::eTransferSrc;
    readable = copying != vk::ImageUsageFlags();
    const vk::SurfaceFormatKHR format = chooseFormat(device, surface);
    imageFormat = format.format;
    blueFirst = imageFormat == vk::Format::eB8G8R8A8Unorm;
    // Some surfaces set their size, others take that of the swapchain.
    constexpr std::uint32_t kAnySize = 0xffffffffu;
    imageSize = limits.currentExtent.width == kAnySize
                    ? glm::clamp(size, glm::uvec2(limits.minImageExtent.width, limits.minImageExtent.height),
                                 glm::uvec2(limits.maxImageExtent.width, limits.maxImageExtent.height))
                    : glm::uvec2(limits.currentExtent.width, limits.currentExtent.height);
    if (imageSize.x == 0 || imageSize.y == 0) {
        return;
    }
    const std::uint32_t most = limits.maxImageCount == 0 ? kAnySize : limits.maxImageCount;

    vk::SwapchainCreateInfoKHR info;
    info.surface = *surface;
    info.minImageCount = std::min(std::max(limits.minImageCount + 1, 2u), most);
    info.imageFormat = format.format;
    info.imageColorSpace = format.colorSpace;
    info.imageExtent = vk::Extent2D(imageSize.x, imageSize.y);
    info.imageArrayLayers = 1;
    info.imageUsage = usage | copying;
    info.preTransform = limits.currentTransform;
    info.compositeAlpha = chooseAlpha(limits);
    info.presentMode = chooseMode(device, surface);
    info.clipped = VK_TRUE;
    info.oldSwapchain = previous == nullptr ? vk::SwapchainKHR() : *previous->swapchain;
    swapchain = {device.handle(), info};
    for (const VkImage image : swapchain.getImages()) {
        images.emplace_back(image);
        views.emplace_back(device.handle(),
                           vk::ImageViewCreateInfo({}, images.back(), vk::ImageViewType::e2D, imageFormat, {},
                                                   {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}));
    }
}

} // namespace metamarch::viewer
