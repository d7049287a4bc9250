// SPDX-License-Identifier: MIT
// Copies between the host and device-local buffers, through host-visible memory of bounded size.
#pragma once
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/device.h"
#include "metamarch/vulkan/submission.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace metamarch::vulkan {

// The most host-visible memory that a transfer uses, in bytes. Longer data is copied in chunks of this size.
inline constexpr uint64_t kTransferChunkSize = uint64_t{16} << 20;

// What transfers of a device reuse: mapped memory, which grows up to kTransferChunkSize, and a submission.
class Staging {
  public:
    explicit Staging(const Device& device) : device_(device), submission_(device) {}

    // Returns memory of at least so many bytes. It is overwritten by the next transfer.
    const Buffer& toDevice(uint64_t size) { return grown(upload_, BufferUse::upload, size); }
    const Buffer& fromDevice(uint64_t size) { return grown(readback_, BufferUse::readback, size); }
    Submission& submission() { return submission_; }

  private:
    const Buffer& grown(std::optional<Buffer>& buffer, BufferUse use, uint64_t size);

    const Device& device_;
    std::optional<Buffer> upload_;
    std::optional<Buffer> readback_;
    Submission submission_;
};

// Overwrites data.size() bytes of `buffer`, starting at byte `offset`. Returns when the device has them.
void write(const Device& device, const Buffer& buffer, uint64_t offset, std::span<const std::byte> data);

// Fills `data` from `buffer`, starting at byte `offset`.
void read(const Device& device, const Buffer& buffer, uint64_t offset, std::span<std::byte> data);

// Returns a new storage buffer that holds `data`. Throws Error(outOfMemory).
Buffer upload(const Device& device, std::span<const std::byte> data, std::string name);

// Likewise, for any container of plain values: upload(device, std::span(triangles), "triangles").
template <class T>
Buffer upload(const Device& device, std::span<T> values, std::string name) {
    static_assert(std::is_trivially_copyable_v<T>);
    return upload(device, std::as_bytes(values), std::move(name));
}

// Returns the whole buffer as values of T; its size must be a multiple of sizeof(T).
template <class T>
std::vector<T> download(const Device& device, const Buffer& buffer) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(buffer.size() / sizeof(T));
    read(device, buffer, 0, std::as_writable_bytes(std::span(values)));
    return values;
}

} // namespace metamarch::vulkan
