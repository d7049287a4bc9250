// SPDX-License-Identifier: MIT
// The driver's compiled pipelines, kept on disk between runs.
#pragma once
#include <vulkan/vulkan_raii.hpp>

#include <filesystem>
#include <optional>

namespace metamarch::vulkan {

// Reads the cache from disk when constructed and writes it back when destroyed. The cache is a convenience: a
// missing, damaged or foreign file is ignored, and a failure to write is not an error.
class PipelineCache {
  public:
    PipelineCache(const vk::raii::PhysicalDevice& physicalDevice, const vk::raii::Device& device);
    PipelineCache(PipelineCache&&) noexcept = default;
    ~PipelineCache();

    const vk::raii::PipelineCache& handle() const { return cache_; }

  private:
    std::optional<std::filesystem::path> file_;
    vk::raii::PipelineCache cache_;
};

// Returns the file for exactly this device and driver, in $XDG_CACHE_HOME/metamarch or ~/.cache/metamarch;
// nothing if neither variable holds an absolute path.
std::optional<std::filesystem::path> pipelineCacheFile(const vk::PhysicalDeviceProperties& properties);

} // namespace metamarch::vulkan
