// The driver's compiled pipelines, kept on disk between runs.
#pragma once
#include <vulkan/vulkan_raii.hpp>

#include <filesystem>
#include <optional>

namespace metamarch::vulkan {

// Read from disk when made, written back when destroyed. A cache is a convenience: a missing, damaged or
// foreign file is ignored, and a failure to write is no error.
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

// The file for this very device and driver, in $XDG_CACHE_HOME/metamarch or ~/.cache/metamarch; nothing when
// neither variable holds an absolute path.
std::optional<std::filesystem::path> pipelineCacheFile(const vk::PhysicalDeviceProperties& properties);

} // namespace metamarch::vulkan
