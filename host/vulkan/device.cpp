// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/device.h"

#include "metamarch/vulkan/compiled_kernel.h"
#include "metamarch/vulkan/device_choice.h"
#include "metamarch/vulkan/pipeline_cache.h"
#include "metamarch/vulkan/refusal.h"
#include "metamarch/vulkan/transfer.h"

#include <fmt/format.h>
#include <vulkan/vulkan_raii.hpp>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace metamarch::vulkan {
namespace {

DeviceReport chosenReport(const Context& context, const std::string& selection,
                          const PresentSupport& presents) {
    std::vector<DeviceReport> reports = reportDevices(context, presents);
    return std::move(reports[chooseDevice(reports, selection)]);
}

vk::raii::Device openDevice(const vk::raii::PhysicalDevice& physicalDevice, const DeviceReport& report) {
    // If a device lists this extension, it must be enabled. Its name is defined only in a header for beta
    // extensions.
    constexpr const char* kPortabilitySubset = "VK_KHR_portability_subset";
    std::vector<const char*> extensions;
    for (const vk::ExtensionProperties& extension : physicalDevice.enumerateDeviceExtensionProperties()) {
        if (std::strcmp(extension.extensionName, kPortabilitySubset) == 0) {
            extensions.push_back(kPortabilitySubset);
        }
    }

    if (report.isForWindow) {
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
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

    checkAddressLimit();
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

struct Device::Handles {
    Handles(const vk::raii::PhysicalDevice& usedDevice, const DeviceReport& report)
        : physicalDevice(usedDevice), memoryProperties(physicalDevice.getMemoryProperties()),
          device(openDevice(physicalDevice, report)), queue(device, report.computeQueueFamily.value(), 0),
          commandPool(device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                               report.computeQueueFamily.value()}),
          pipelineCache(physicalDevice, device) {}

    const vk::raii::PhysicalDevice& physicalDevice; // owned by the context
    vk::PhysicalDeviceMemoryProperties memoryProperties;
    vk::raii::Device device;
    vk::raii::Queue queue;
    vk::raii::CommandPool commandPool;
    PipelineCache pipelineCache;
    CompiledKernels kernels;
    MemoryUse memoryUse;
    std::unique_ptr<Staging> staging; // made by the first transfer
};

Device::Device(const Context& context, const std::string& selection, const PresentSupport& presents)
    : Device(context, chosenReport(context, selection, presents)) {}

Device::Device(const Context& context, DeviceReport report)
    : report_(std::move(report)),
      handles_(std::make_unique<Handles>(context.physicalDevices()[report_.index], report_)) {}

Device::~Device() {
    handles_->staging.reset(); // it uses the rest
}

const vk::raii::Device& Device::handle() const { return handles_->device; }
const vk::raii::PhysicalDevice& Device::physicalDevice() const { return handles_->physicalDevice; }
const vk::raii::Queue& Device::queue() const { return handles_->queue; }
const vk::raii::CommandPool& Device::commandPool() const { return handles_->commandPool; }

std::shared_ptr<const CompiledKernel> Device::compile(KernelSource source) const {
    return handles_->kernels.compile(handles_->device, handles_->pipelineCache, std::move(source));
}

const vk::PhysicalDeviceMemoryProperties& Device::memoryProperties() const {
    return handles_->memoryProperties;
}

MemoryUse& Device::memoryUse() const { return handles_->memoryUse; }

Staging& Device::staging() const {
    if (!handles_->staging) {
        handles_->staging = std::make_unique<Staging>(*this);
    }
    return *handles_->staging;
}

uint64_t Device::freeMemory() const {
    const vk::PhysicalDeviceMemoryProperties& memory = memoryProperties();
    uint32_t largest = 0;
    uint64_t size = 0;
    for (uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap) {
        const vk::MemoryHeap& found = memory.memoryHeaps[heap];
        if ((found.flags & vk::MemoryHeapFlagBits::eDeviceLocal) && found.size > size) {
            largest = heap;
            size = found.size;
        }
    }
    uint64_t used = memoryUse().ofHeap[largest];
    if (report_.hasMemoryBudget) {
        const auto now = physicalDevice()
                             .getMemoryProperties2<vk::PhysicalDeviceMemoryProperties2,
                                                   vk::PhysicalDeviceMemoryBudgetPropertiesEXT>()
                             .get<vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
        size = std::min(size, now.heapBudget[largest]);
        used = now.heapUsage[largest];
    }
    return size - std::min(used, size);
}

bool Device::waitIdle() const {
    try {
        handles_->device.waitIdle();
        return true;
    } catch (const vk::SystemError&) {
        return false;
    }
}

} // namespace metamarch::vulkan
