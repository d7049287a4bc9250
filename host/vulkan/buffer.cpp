// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/buffer.h"

#include "metamarch/error/error.h"
#include "metamarch/vulkan/byte_text.h"

#include <fmt/format.h>
#include <vulkan/vulkan_raii.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace metamarch::vulkan {
namespace {

constexpr uint64_t kLeastSize = 16; // bytes; replaces a size of 0, which Vulkan forbids

vk::BufferUsageFlags usageOf(BufferUse use) {
    using Usage = vk::BufferUsageFlagBits;
    switch (use) {
    case BufferUse::upload:
        return Usage::eTransferSrc;
    case BufferUse::readback:
        return Usage::eTransferDst;
    case BufferUse::hierarchyInput:
        return Usage::eAccelerationStructureBuildInputReadOnlyKHR | Usage::eShaderDeviceAddress |
               Usage::eTransferDst;
    case BufferUse::hierarchy:
        return Usage::eAccelerationStructureStorageKHR | Usage::eShaderDeviceAddress;
    case BufferUse::scratch:
        return Usage::eStorageBuffer | Usage::eShaderDeviceAddress;
    case BufferUse::storage:
        break;
    }
    return Usage::eStorageBuffer | Usage::eUniformTexelBuffer | Usage::eUniformBuffer | Usage::eTransferSrc |
           Usage::eTransferDst;
}

// Returns the wanted memory properties, best first. Vulkan guarantees that a memory type with the last ones
// exists.
std::vector<vk::MemoryPropertyFlags> memoryWishes(BufferUse use) {
    using Memory = vk::MemoryPropertyFlagBits;
    const vk::MemoryPropertyFlags host = Memory::eHostVisible | Memory::eHostCoherent;
    switch (use) {
    case BufferUse::upload:
        return {host};
    case BufferUse::readback:
        return {host | Memory::eHostCached, host};
    default:
        return {Memory::eDeviceLocal};
    }
}

// Among equal memory types, Vulkan lists the faster one first.
uint32_t chooseMemoryType(const Device& device, uint32_t allowedTypes, BufferUse use) {
    const vk::PhysicalDeviceMemoryProperties& memory = device.memoryProperties();
    for (const vk::MemoryPropertyFlags wish : memoryWishes(use)) {
        for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
            if ((allowedTypes & (1u << type)) != 0 &&
                (memory.memoryTypes[type].propertyFlags & wish) == wish) {
                return type;
            }
        }
    }
    throw Error(ErrorKind::noDevice, fmt::format("{}: no suitable memory for buffers", device.name()));
}

[[noreturn]] void refuseSize(const Device& device, const std::string& buffer, uint64_t size,
                             const std::string& reason) {
    throw Error(ErrorKind::outOfMemory,
                fmt::format("{}: buffer '{}' of {} {}", device.name(), buffer, byteText(size), reason));
}

} // namespace

struct Buffer::Handles {
    vk::raii::Buffer buffer = nullptr;
    vk::raii::DeviceMemory memory = nullptr; // freeing it also unmaps it
};

Buffer::Buffer(const Device& device, BufferUse use, uint64_t size, std::string name)
    : name_(std::move(name)), size_(size), handles_(std::make_unique<Handles>()) {
    const uint64_t largest = device.report().maxMemoryAllocationSize;
    if (size > largest) {
        refuseSize(device, name_, size,
                   fmt::format("is over maxMemoryAllocationSize, {}", byteText(largest)));
    }
    vk::raii::Buffer& buffer = handles_->buffer;
    vk::raii::DeviceMemory& memory = handles_->memory;
    try {
        buffer = {device.handle(), vk::BufferCreateInfo({}, size == 0 ? kLeastSize : size, usageOf(use))};
        const vk::MemoryRequirements needs = buffer.getMemoryRequirements();
        const uint32_t type = chooseMemoryType(device, needs.memoryTypeBits, use);
        const uint64_t heapSize =
            device.memoryProperties().memoryHeaps[device.memoryProperties().memoryTypes[type].heapIndex].size;
        if (needs.size > heapSize) {
            refuseSize(device, name_, size, fmt::format("is over the memory heap, {}", byteText(heapSize)));
        }
        const bool addressed =
            static_cast<bool>(usageOf(use) & vk::BufferUsageFlagBits::eShaderDeviceAddress);
        const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
        memory = {device.handle(), vk::MemoryAllocateInfo(needs.size, type, addressed ? &flags : nullptr)};
        buffer.bindMemory(*memory, 0);
        if (addressed) {
            address_ = device.handle().getBufferAddress(*buffer);
        }
        if (use == BufferUse::upload || use == BufferUse::readback) {
            mapped_ = {static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE)), size};
        }
    } catch (const vk::OutOfDeviceMemoryError&) {
        refuseSize(device, name_, size, "does not fit into device memory");
    } catch (const vk::OutOfHostMemoryError&) {
        refuseSize(device, name_, size, "does not fit into host memory");
    } catch (const vk::MemoryMapFailedError&) {
        refuseSize(device, name_, size, "cannot be mapped into host memory");
    }
}

Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

vk::Buffer Buffer::handle() const { return *handles_->buffer; }

} // namespace metamarch::vulkan
