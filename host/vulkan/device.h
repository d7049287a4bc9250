// SPDX-License-Identifier: MIT
// An open device with a compute queue, a command pool and a pipeline cache.
#pragma once
#include "metamarch/vulkan/compiled_kernel.h"
#include "metamarch/vulkan/context.h"
#include "metamarch/vulkan/device_report.h"
#include "metamarch/vulkan/pipeline_cache.h"

#include <cstdint>
#include <string>

namespace metamarch::vulkan {

// Opens the device that `selection` names (see chooseDevice; empty: the best one). Enables no optional
// feature except ray queries, if the device has them, and for windows VK_KHR_swapchain. Must outlive every
// Buffer, ComputePipeline and Submission made from it; they point to it, so it can be neither copied nor
// moved. Use it from one thread at a time. Throws Error(noDevice).
class Device {
  public:
    explicit Device(const Context& context, const std::string& selection = "",
                    DeviceUse use = DeviceUse::compute);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceReport& report() const { return report_; }
    const std::string& name() const { return report_.name; }
    // Nanoseconds per timestamp tick; 0 if the queue has no timestamps.
    float timestampPeriod() const { return report_.timestampValidBits == 0 ? 0.0f : report_.timestampPeriod; }

    const vk::raii::Device& handle() const { return device_; }
    const vk::raii::PhysicalDevice& physicalDevice() const { return *physicalDevice_; }
    const vk::raii::Queue& queue() const { return queue_; }
    const vk::raii::CommandPool& commandPool() const { return commandPool_; }
    // See CompiledKernels.
    std::shared_ptr<const CompiledKernel> compile(KernelSource source) const {
        return kernels_.compile(device_, pipelineCache_, std::move(source));
    }
    const vk::PhysicalDeviceMemoryProperties& memoryProperties() const { return memoryProperties_; }

  private:
    Device(const Context& context, DeviceReport report);

    DeviceReport report_;
    const vk::raii::PhysicalDevice* physicalDevice_; // owned by the context
    vk::PhysicalDeviceMemoryProperties memoryProperties_;
    vk::raii::Device device_;
    vk::raii::Queue queue_;
    vk::raii::CommandPool commandPool_;
    mutable PipelineCache pipelineCache_;
    mutable CompiledKernels kernels_;
};

} // namespace metamarch::vulkan
