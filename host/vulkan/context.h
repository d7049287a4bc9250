// The Vulkan instance: loader, version, validation. It knows no window: who has one names the extensions.
#pragma once
#include <vulkan/vulkan_raii.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::vulkan {

// What the shaders are compiled for (--target-env vulkan1.2) and the least a device must offer.
inline constexpr uint32_t kApiVersion = VK_API_VERSION_1_2;

// Opens the Vulkan loader. Must outlive every Device made from it.
//
// With METAMARCH_VALIDATION=1 in the environment the Khronos validation layer runs with synchronization
// validation; each of its warnings and errors goes to stderr as one line and is counted.
//
// Throws Error(noDevice), whose line names the package to install, when there is no loader, no driver, no
// device at all, when validation is asked for and its layer is missing, or when the drivers lack one of the
// `instanceExtensions`, which windows take.
class Context {
  public:
    explicit Context(std::span<const char* const> instanceExtensions = {});

    const vk::raii::Instance& instance() const { return instance_; }

    // In the order of the loader: the INDEX of --device.
    const std::vector<vk::raii::PhysicalDevice>& physicalDevices() const { return physicalDevices_; }

  private:
    vk::raii::Context loader_;
    vk::raii::Instance instance_;
    vk::raii::DebugUtilsMessengerEXT messenger_; // destroyed before the instance it listens to
    std::vector<vk::raii::PhysicalDevice> physicalDevices_;
};

// Warnings and errors of the validation layer since the program began. Counted per process and not per
// Context: the layer reports leaked objects while the instance dies, and main() must still see them
// afterwards.
uint32_t validationMessages();

} // namespace metamarch::vulkan
