// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace metamarch::vulkan {

const Buffer& Staging::grown(std::optional<Buffer>& buffer, const BufferUse use, const uint64_t size) {
    if (!buffer || buffer->size() < size) {
        buffer.reset(); // the old memory makes room for the new
        buffer.emplace(device_, use, std::bit_ceil(size), "staging");
    }
    return *buffer;
}

void write(const Device& device, const Buffer& buffer, uint64_t offset, std::span<const std::byte> data) {
    if (data.empty()) {
        return;
    }
    const Buffer& staging = device.staging().toDevice(std::min<uint64_t>(data.size(), kTransferChunkSize));
    while (!data.empty()) {
        const uint64_t size = std::min<uint64_t>(data.size(), staging.size());
        std::memcpy(staging.mapped().data(), data.data(), size);
        device.staging().submission().run(
            [&](Commands& commands) { commands.copy(staging, 0, buffer, offset, size); });
        data = data.subspan(size);
        offset += size;
    }
}

void read(const Device& device, const Buffer& buffer, uint64_t offset, std::span<std::byte> data) {
    if (data.empty()) {
        return;
    }
    const Buffer& staging = device.staging().fromDevice(std::min<uint64_t>(data.size(), kTransferChunkSize));
    while (!data.empty()) {
        const uint64_t size = std::min<uint64_t>(data.size(), staging.size());
        device.staging().submission().run(
            [&](Commands& commands) { commands.copy(buffer, offset, staging, 0, size); });
        std::memcpy(data.data(), staging.mapped().data(), size);
        data = data.subspan(size);
        offset += size;
    }
}

Buffer upload(const Device& device, std::span<const std::byte> data, std::string name) {
    Buffer buffer(device, BufferUse::storage, data.size(), std::move(name));
    if (!buffer.writeFromHost(data)) {
        write(device, buffer, 0, data);
    }
    return buffer;
}

} // namespace metamarch::vulkan
