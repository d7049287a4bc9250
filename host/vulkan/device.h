// SPDX-License-Identifier: MIT
// An open device with a compute queue, a command pool and a pipeline cache.
#pragma once
#include "metamarch/vulkan/context.h"
#include "metamarch/vulkan/device_report.h"
#include "metamarch/vulkan/handle_types.h"

#include <array>
#include <memory>
#include <string>

namespace metamarch::vulkan {

struct CompiledKernel;
struct KernelSource;
class Staging;

// What the buffers of a device take of its memory, in bytes.
struct MemoryUse {
    std::array<uint64_t, VK_MAX_MEMORY_HEAPS> ofHeap{};
    uint64_t spilled = 0;     // of buffers that found no place in device-local memory
    uint64_t allocations = 0; // a number: how many there have been
};

// Opens the device that `selection` names (see chooseDevice; empty: the best one). Enables no optional
// feature except ray queries, if the device has them, and VK_KHR_swapchain with `presents`, for a window.
// Must outlive every Buffer, ComputePipeline and Submission made from it; they point to it, so it can be
// neither copied nor moved. Use it from one thread at a time. Throws Error(noDevice).
class Device {
  public:
    explicit Device(const Context& context, const std::string& selection = "",
                    const PresentSupport& presents = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceReport& report() const { return report_; }
    const std::string& name() const { return report_.name; }
    // Nanoseconds per timestamp tick; 0 if the queue has no timestamps.
    float timestampPeriod() const { return report_.timestampValidBits == 0 ? 0.0f : report_.timestampPeriod; }

    const vk::raii::Device& handle() const;
    const vk::raii::PhysicalDevice& physicalDevice() const;
    const vk::raii::Queue& queue() const;
    const vk::raii::CommandPool& commandPool() const;
    // See CompiledKernels.
    std::shared_ptr<const CompiledKernel> compile(KernelSource source) const;
    const vk::PhysicalDeviceMemoryProperties& memoryProperties() const;
    MemoryUse& memoryUse() const; // each Buffer adds what it takes
    Staging& staging() const;     // for transfers
    // Bytes of the largest device-local heap that are probably free: what the driver grants this process, or,
    // without VK_EXT_memory_budget, what our own buffers leave of the heap.
    uint64_t freeMemory() const;

    // Waits until the device has no more work. Returns false if the device is lost.
    bool waitIdle() const;

  private:
    struct Handles;

    Device(const Context& context, DeviceReport report);

    DeviceReport report_;
    std::unique_ptr<Handles> handles_;
};

} // namespace metamarch::vulkan
