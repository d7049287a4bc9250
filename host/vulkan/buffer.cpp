// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/buffer.h"

#include "metamarch/error/error.h"
#include "metamarch/vulkan/byte_text.h"

#include <fmt/format.h>
#include <vulkan/vulkan_raii.hpp>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

namespace metamarch::vulkan {
namespace {

constexpr uint64_t kLeastSize = 16; // bytes; replaces a size of 0, which Vulkan forbids
// Memory that the host reads and writes without flushes.
constexpr vk::MemoryPropertyFlags kVisible =
    vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;

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

bool isMapped(BufferUse use) { return use == BufferUse::upload || use == BufferUse::readback; }

// Returns the wanted memory properties, best first. Vulkan guarantees that a memory type with host memory
// exists, and one that is device-local. A device also reads and writes host memory, only more slowly.
std::vector<vk::MemoryPropertyFlags> memoryWishes(BufferUse use) {
    switch (use) {
    case BufferUse::upload:
        return {kVisible};
    case BufferUse::readback:
        return {kVisible | vk::MemoryPropertyFlagBits::eHostCached, kVisible};
    default:
        return {vk::MemoryPropertyFlagBits::eDeviceLocal, kVisible};
    }
}

// Returns the types of memory that suit, best first. Among equal ones, Vulkan lists the faster one first.
std::vector<uint32_t> memoryTypes(const Device& device, uint32_t allowedTypes, BufferUse use) {
    // Types that take a feature which we do not enable.
    constexpr vk::MemoryPropertyFlags kSpecial =
        vk::MemoryPropertyFlagBits::eProtected | vk::MemoryPropertyFlagBits::eDeviceCoherentAMD;
    const vk::PhysicalDeviceMemoryProperties& memory = device.memoryProperties();
    std::vector<uint32_t> types;
    for (const vk::MemoryPropertyFlags wish : memoryWishes(use)) {
        for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
            const vk::MemoryPropertyFlags has = memory.memoryTypes[type].propertyFlags;
            if ((allowedTypes & (1u << type)) != 0 && (has & wish) == wish && !(has & kSpecial) &&
                std::ranges::find(types, type) == types.end()) {
                types.push_back(type);
            }
        }
    }
    if (types.empty()) {
        throw Error(ErrorKind::noDevice, fmt::format("{}: no suitable memory for buffers", device.name()));
    }
    return types;
}

[[noreturn]] void refuseSize(const Device& device, const std::string& buffer, uint64_t size,
                             const std::string& reason) {
    throw Error(ErrorKind::outOfMemory,
                fmt::format("{}: buffer '{}' of {} {}", device.name(), buffer, byteText(size), reason));
}

} // namespace

struct Buffer::Handles {
    explicit Handles(const Device& usedDevice) : device(usedDevice) {}
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        device.memoryUse().ofHeap[heap] -= taken;
        device.memoryUse().spilled -= spilled;
    }

    bool allocate(const vk::MemoryRequirements& needs, BufferUse use);

    const Device& device;
    vk::raii::Buffer buffer = nullptr;
    vk::raii::DeviceMemory memory = nullptr; // freeing it also unmaps it
    uint32_t heap = 0;
    uint64_t taken = 0; // bytes of the heap
    uint64_t spilled = 0;
    bool isVisible = false; // to the host, without flushes
};

// Takes the best memory that has room. Returns false if none has.
bool Buffer::Handles::allocate(const vk::MemoryRequirements& needs, const BufferUse use) {
    const bool addressed = static_cast<bool>(usageOf(use) & vk::BufferUsageFlagBits::eShaderDeviceAddress);
    const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
    const vk::PhysicalDeviceMemoryProperties& properties = device.memoryProperties();
    for (const uint32_t type : memoryTypes(device, needs.memoryTypeBits, use)) {
        const vk::MemoryType& found = properties.memoryTypes[type];
        if (needs.size > properties.memoryHeaps[found.heapIndex].size) {
            continue; // Vulkan forbids to ask for it
        }
        try {
            memory = {device.handle(),
                      vk::MemoryAllocateInfo(needs.size, type, addressed ? &flags : nullptr)};
        } catch (const vk::OutOfDeviceMemoryError&) {
            continue;
        }
        const bool isHost = !(found.propertyFlags & vk::MemoryPropertyFlagBits::eDeviceLocal);
        isVisible = (found.propertyFlags & kVisible) == kVisible;
        heap = found.heapIndex;
        taken = needs.size;
        spilled = isHost && !isMapped(use) ? needs.size : 0;
        device.memoryUse().ofHeap[heap] += taken;
        device.memoryUse().spilled += spilled;
        ++device.memoryUse().allocations;
        return true;
    }
    return false;
}

Buffer::Buffer(const Device& device, BufferUse use, uint64_t size, std::string name)
    : name_(std::move(name)), size_(size), handles_(std::make_unique<Handles>(device)) {
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
        if (!handles_->allocate(needs, use)) {
            refuseSize(device, name_, size,
                       fmt::format("does not fit into device memory, of which {} are free",
                                   byteText(device.freeMemory())));
        }
        buffer.bindMemory(*memory, 0);
        if (usageOf(use) & vk::BufferUsageFlagBits::eShaderDeviceAddress) {
            address_ = device.handle().getBufferAddress(*buffer);
        }
        if (isMapped(use)) {
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

bool Buffer::writeFromHost(const std::span<const std::byte> data) {
    if (!handles_->isVisible || data.empty()) {
        return false;
    }
    try {
        std::memcpy(handles_->memory.mapMemory(0, VK_WHOLE_SIZE), data.data(), data.size());
    } catch (const vk::SystemError&) { // too little memory or address space: the caller copies in parts
        return false;
    }
    handles_->memory.unmapMemory();
    return true;
}

vk::Buffer Buffer::handle() const { return *handles_->buffer; }

} // namespace metamarch::vulkan
