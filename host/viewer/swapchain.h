// SPDX-License-Identifier: MIT
// The images that a window shows in turn.
#pragma once
#include "metamarch/vulkan/device.h"

#include <glm/glm.hpp>
#include <vulkan/vulkan_raii.hpp>

#include <cstdint>
#include <vector>

namespace metamarch::viewer {

// A swapchain is for one size of the window; after a change of size, a new one replaces it.
class Swapchain {
  public:
    // Retires `previous`, which may be null. Is empty, and retires nothing, if the surface has no size.
    // Throws Error(noDevice) if the device cannot present to the surface, and vk::SystemError.
    Swapchain(const vulkan::Device& device, const vk::raii::SurfaceKHR& surface, glm::uvec2 size,
              const Swapchain* previous);

    bool isEmpty() const { return images.empty(); }
    // Says whether blue is the first byte of a pixel. The format has 8 bits per channel and is not an sRGB
    // format, so the bytes are shown unchanged.
    bool isBlueFirst() const { return blueFirst; }
    bool isReadable() const { return readable; } // its images can be copied from
    vk::Format format() const { return imageFormat; }
    glm::uvec2 size() const { return imageSize; }
    std::uint32_t count() const { return static_cast<std::uint32_t>(images.size()); }
    vk::Image image(const std::uint32_t index) const { return images[index]; }
    vk::ImageView view(const std::uint32_t index) const { return *views[index]; }
    const vk::raii::SwapchainKHR& handle() const { return swapchain; }

  private:
    bool blueFirst = false;
    bool readable = false;
    vk::Format imageFormat = vk::Format::eUndefined;
    glm::uvec2 imageSize{0};
    vk::raii::SwapchainKHR swapchain = nullptr;
    std::vector<vk::Image> images; // owned by the swapchain
    std::vector<vk::raii::ImageView> views;
};

} // namespace metamarch::viewer
