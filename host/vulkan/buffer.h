// One buffer and the memory it lives in.
#pragma once
#include "metamarch/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace metamarch::vulkan {

enum class BufferUse {
    storage,  // device-local; shaders read and write it, or read it as constants, transfers fill and read it
    upload,   // host memory the device copies from; mapped
    readback, // host memory the device copies to; mapped, cached where the device can
    // For a BoxHierarchy, device-local too: what it is built from, what it lives in, what building it takes.
    hierarchyInput,
    hierarchy,
    scratch,
};

// Move-only; the name appears in error messages.
class Buffer {
  public:
    // `size` in bytes; 0 is allowed (an empty scene has empty tables) and allocates the least possible.
    // Throws Error(outOfMemory), naming buffer and size, when the device cannot hold it. The limit on what a
    // shader can see of it (maxStorageBufferRange) is checked where it is bound: ComputePipeline::bind.
    Buffer(const Device& device, BufferUse use, uint64_t size, std::string name);

    const std::string& name() const { return name_; }
    uint64_t size() const { return size_; } // as asked for
    vk::Buffer handle() const { return *buffer_; }
    vk::DeviceAddress address() const { return address_; } // of a buffer for a BoxHierarchy; else 0
    // The bytes as the host sees them; empty where they are device-local. Reading is valid after a Submission
    // has been waited for.
    std::span<std::byte> mapped() const { return mapped_; }

  private:
    std::string name_;
    uint64_t size_;
    vk::raii::Buffer buffer_ = nullptr;
    vk::raii::DeviceMemory memory_ = nullptr; // freeing it unmaps it
    vk::DeviceAddress address_ = 0;
    std::span<std::byte> mapped_;
};

} // namespace metamarch::vulkan
