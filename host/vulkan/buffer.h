// SPDX-License-Identifier: MIT
// A buffer with its own memory.
#pragma once
#include "metamarch/vulkan/device.h"
#include "metamarch/vulkan/handle_types.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace metamarch::vulkan {

enum class BufferUse {
    storage,  // device-local; shaders read and write it, or read it as constants; transfers fill and read it
    upload,   // host memory, mapped; the device copies from it
    readback, // host memory, mapped, cached if possible; the device copies to it
    // Device-local, for a BoxHierarchy: the input of the build, the hierarchy itself, and the build's scratch
    // memory.
    hierarchyInput,
    hierarchy,
    scratch,
};

// Move-only. The name appears in error messages.
class Buffer {
  public:
    // `size` is in bytes; 0 is allowed (an empty scene has empty tables) and allocates the minimum. Throws
    // Error(outOfMemory), naming buffer and size, if the device cannot hold it. ComputePipeline::bind checks
    // the limit on what a shader can see of a buffer (maxStorageBufferRange).
    Buffer(const Device& device, BufferUse use, uint64_t size, std::string name);
    ~Buffer();
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;

    const std::string& name() const { return name_; }
    uint64_t size() const { return size_; } // bytes, as requested
    vk::Buffer handle() const;
    VkDeviceAddress address() const { return address_; } // for buffers of a BoxHierarchy; otherwise 0
    // The bytes as mapped for the host; empty for device-local buffers. Read them only after waiting for the
    // Submission that writes them.
    std::span<std::byte> mapped() const { return mapped_; }
    // Writes the first bytes of a device-local buffer that no submission has used yet. Returns false, and
    // writes nothing, where the host does not see or cannot map device memory.
    bool writeFromHost(std::span<const std::byte> data);

  private:
    struct Handles;

    std::string name_;
    uint64_t size_;
    std::unique_ptr<Handles> handles_;
    VkDeviceAddress address_ = 0;
    std::span<std::byte> mapped_;
};

} // namespace metamarch::vulkan
