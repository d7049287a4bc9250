// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/pipeline_cache.h"

#include "metamarch/file/output_file.h"
#include "metamarch/file/user_folder.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <system_error>
#include <utility>

namespace metamarch::vulkan {
namespace {

namespace fs = std::filesystem;

// Our header before the driver's bytes. Drivers may crash on damaged data (Vulkan forbids passing it to
// them), so we check every byte ourselves.
struct FileHeader {
    char magic[8];
    uint64_t size; // number of bytes that follow
    uint64_t hash; // hashOf those bytes
};
constexpr char kMagic[8] = {'M', 'M', 'C', 'A', 'C', 'H', 'E', '1'};

// FNV-1a with 64 bits: http://www.isthe.com/chongo/tech/comp/fnv/
uint64_t hashOf(std::span<const uint8_t> bytes) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (const uint8_t byte : bytes) {
        hash = (hash ^ byte) * 0x100000001b3u;
    }
    return hash;
}

bool isForDevice(std::span<const uint8_t> data, const vk::PhysicalDeviceProperties& properties) {
    VkPipelineCacheHeaderVersionOne header;
    if (data.size() < sizeof header) {
        return false;
    }
    std::memcpy(&header, data.data(), sizeof header);
    return header.headerSize == sizeof header &&
           header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
           std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID.data(), VK_UUID_SIZE) == 0;
}

// Returns the driver's bytes, or none if the file is missing, damaged or belongs to another device.
std::vector<uint8_t> readCache(const fs::path& file, const vk::PhysicalDeviceProperties& properties) {
    std::ifstream stream(file, std::ios::binary);
    FileHeader header;
    if (!stream.read(reinterpret_cast<char*>(&header), sizeof header) ||
        std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) {
        return {};
    }
    std::vector<uint8_t> data(std::istreambuf_iterator<char>(stream), {});
    const bool whole = data.size() == header.size && hashOf(data) == header.hash;
    return whole && isForDevice(data, properties) ? data : std::vector<uint8_t>();
}

void writeCache(const fs::path& file, std::span<const uint8_t> data) {
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    FileHeader header{{}, data.size(), hashOf(data)};
    std::memcpy(header.magic, kMagic, sizeof kMagic);
    OutputFile output(file);
    output.write(0, &header, sizeof header);
    output.write(sizeof header, data.data(), data.size());
    output.commit();
}

} // namespace

std::optional<fs::path> pipelineCacheFile(const vk::PhysicalDeviceProperties& properties) {
    const std::optional<fs::path> folder = userFolder("XDG_CACHE_HOME", ".cache");
    if (!folder) {
        return std::nullopt;
    }
    return *folder / fmt::format("pipelines-{:08x}-{:08x}-{:08x}-{:02x}.bin", properties.vendorID,
                                 properties.deviceID, properties.driverVersion,
                                 fmt::join(properties.pipelineCacheUUID, ""));
}

PipelineCache::PipelineCache(const vk::raii::PhysicalDevice& physicalDevice, const vk::raii::Device& device)
    : file_(pipelineCacheFile(physicalDevice.getProperties())),
      onDisk_(file_ ? readCache(*file_, physicalDevice.getProperties()) : std::vector<uint8_t>()),
      cache_(device, vk::PipelineCacheCreateInfo({}, onDisk_.size(), onDisk_.data())) {}

void PipelineCache::save() {
    if (!file_) {
        return;
    }
    try {
        std::vector<uint8_t> data = cache_.getData();
        if (data != onDisk_) {
            writeCache(*file_, data);
            onDisk_ = std::move(data);
        }
    } catch (const std::exception&) {
        // The next run compiles again.
    }
}

} // namespace metamarch::vulkan
