#include "vulkan/device.h"

#include "vulkan/device_choice.h"
#include "vulkan/refusal.h"

#include <fmt/format.h>

#include <cstring>
#include <utility>
#include <vector>

namespace metamarch::vulkan {
namespace {

DeviceReport chosenReport(const Context& context, const std::string& selection) {
    std::vector<DeviceReport> reports = reportDevices(context);
    return std::move(reports[chooseDevice(reports, selection)]);
}

vk::raii::Device openDevice(const vk::raii::PhysicalDevice& physicalDevice, const DeviceReport& report) {
    // A device that lists this extension must be opened with it. Its name is in a header for beta extensions
    // only.
    constexpr const char* kPortabilitySubset = "VK_KHR_portability_subset";
    std::vector<const char*> extensions;
    for (const vk::ExtensionProperties& extension : physicalDevice.enumerateDeviceExtensionProperties()) {
        if (std::strcmp(extension.extensionName, kPortabilitySubset) == 0) {
            extensions.push_back(kPortabilitySubset);
        }
    }

    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceRayQueryFeaturesKHR,
                       vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                       vk::PhysicalDeviceBufferDeviceAddressFeatures>
        chain;
    if (report.hasRayQuery()) {
        extensions.insert(extensions.end(), kRayQueryExtensions.begin(), kRayQueryExtensions.end());
        chain.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().setRayQuery(VK_TRUE);
        chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().setAccelerationStructure(VK_TRUE);
        chain.get<vk::PhysicalDeviceBufferDeviceAddressFeatures>().setBufferDeviceAddress(VK_TRUE);
    } else {
        chain.unlink<vk::PhysicalDeviceRayQueryFeaturesKHR>();
        chain.unlink<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>();
        chain.unlink<vk::PhysicalDeviceBufferDeviceAddressFeatures>();
    }

    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, report.computeQueueFamily.value(), 1, &priority);
    chain.get<vk::DeviceCreateInfo>().setQueueCreateInfos(queue).setPEnabledExtensionNames(extensions);
    try {
        return {physicalDevice, chain.get<vk::DeviceCreateInfo>()};
    } catch (const vk::SystemError& error) {
        throw refusalOf(error, fmt::format("{}: cannot be opened", report.name));
    }
}

} // namespace

Device::Device(const Context& context, const std::string& selection)
    : Device(context, chosenReport(context, selection)) {}

Device::Device(const Context& context, DeviceReport report)
    : report_(std::move(report)),
      memoryProperties_(context.physicalDevices()[report_.index].getMemoryProperties()),
      device_(openDevice(context.physicalDevices()[report_.index], report_)),
      queue_(device_, report_.computeQueueFamily.value(), 0),
      commandPool_(device_,
                   {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, report_.computeQueueFamily.value()}),
      pipelineCache_(context.physicalDevices()[report_.index], device_) {}

} // namespace metamarch::vulkan
