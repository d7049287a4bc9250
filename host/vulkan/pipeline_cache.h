// SPDX-License-Identifier: MIT
// The driver's compiled pipelines, kept on disk between runs.
#pragma once
#include <vulkan/vulkan_raii.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace metamarch::vulkan {

// Reads the cache from disk when constructed. The cache is a convenience: a missing, damaged or foreign file
// is ignored, and a failure to write is not an error.
class PipelineCache {
  public:
    PipelineCache(const vk::raii::PhysicalDevice& physicalDevice, const vk::raii::Device& device);

    const vk::raii::PipelineCache& handle() const { return cache_; }

    // Writes the cache to disk if it has changed. Call it after making a pipeline: a program may end without
    // closing its device, and a driver may take half a minute for one kernel.
    void save();

  private:
    std::optional<std::filesystem::path> file_;
    std::vector<std::uint8_t> onDisk_; // the driver's bytes in the file, as far as this process knows
    vk::raii::PipelineCache cache_;
};

// Returns the file for exactly this device and driver, in $XDG_CACHE_HOME/metamarch or ~/.cache/metamarch;
// nothing if neither variable holds an absolute path.
std::optional<std::filesystem::path> pipelineCacheFile(const vk::PhysicalDeviceProperties& properties);

} // namespace metamarch::vulkan
