// SPDX-License-Identifier: MIT
// The Vulkan instance: loader, version, validation. It knows nothing about windows; a caller with a window
// passes the extensions for it.
#pragma once
#include "metamarch/vulkan/handle_types.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace metamarch::vulkan {

// The Vulkan version that shaders are compiled for (--target-env vulkan1.2) and that a device must support at
// least.
inline constexpr uint32_t kApiVersion = VK_API_VERSION_1_2;

// Opens the Vulkan loader. Must outlive every Device made from it.
//
// If the environment has METAMARCH_VALIDATION=1, the Khronos validation layer runs with synchronization
// validation. Each of its warnings and errors is counted and written to stderr as one line.
//
// Throws Error(noDevice), naming the package to install, if there is no loader, no driver or no device, if
// validation is requested and its layer is missing, or if the drivers lack one of `instanceExtensions`, which
// windows need.
class Context {
  public:
    explicit Context(std::span<const char* const> instanceExtensions = {});
    ~Context();

    const vk::raii::Instance& instance() const;

    // Returns the devices in the loader's order; chooseDevice counts them in this order.
    const std::vector<vk::raii::PhysicalDevice>& physicalDevices() const;

  private:
    struct Handles;

    std::unique_ptr<Handles> handles_;
};

// Returns the number of warnings and errors of the validation layer since the program started. They are
// counted per process rather than per Context: the layer reports leaked objects while the instance is
// destroyed, and main() must still see them afterwards.
uint32_t validationMessages();

} // namespace metamarch::vulkan
