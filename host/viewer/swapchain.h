// SPDX-License-Identifier: MIT
// The images that a window shows one after the other.
#pragma once
#include "metamarch/vulkan/device.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace metamarch::viewer {

// One size of a window: a window that changes gets another.
class Swapchain {
  public:
    // `previous` is retired by it, where there is one. Throws Error(noDevice) where the device cannot present
    // to the surface, and vk::SystemError.
    Swapchain(const vulkan::Device& device, const vk::raii::SurfaceKHR& surface, glm::uvec2 size,
              const Swapchain* previous);

    // Bytes lie as the swapchain's 8-bit format wants them: without a curve of its own.
    bool isBlueFirst() const { return blueFirst; }
    vk::Format format() const { return imageFormat; }
    glm::uvec2 size() const { return imageSize; }
    std::uint32_t count() const { return static_cast<std::uint32_t>(images.size()); }
    vk::Image image(const std::uint32_t index) const { return images[index]; }
    vk::ImageView view(const std::uint32_t index) const { return *views[index]; }
    const vk::raii::SwapchainKHR& handle() const { return swapchain; }

  private:
    bool blueFirst = false;
    vk::Format imageFormat = vk::Format::eUndefined;
    glm::uvec2 imageSize{0};
    vk::raii::SwapchainKHR swapchain = nullptr;
    std::vector<vk::Image> images; // the swapchain's
    std::vector<vk::raii::ImageView> views;
};

} // namespace metamarch::viewer
