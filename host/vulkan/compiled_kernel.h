// SPDX-License-Identifier: MIT
// Kernels as the driver has compiled them, without buffers.
#pragma once
#include "metamarch/vulkan/exact_floats.h"
#include "metamarch/vulkan/pipeline_cache.h"

#include <vulkan/vulkan_raii.hpp>

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace metamarch::vulkan {

// Everything that a kernel is compiled from.
struct KernelSource {
    std::vector<uint32_t> spirv;                     // as the build has made it
    std::map<uint32_t, vk::DescriptorType> bindings; // of set 0
    uint32_t pushConstantSize = 0;
    std::map<uint32_t, uint32_t> specialization;
    FloatModes floatModes{};
    bool simplifiesBranches = false;

    bool operator==(const KernelSource&) const = default;
};

struct CompiledKernel {
    CompiledKernel(const vk::raii::Device& device, const vk::raii::PipelineCache& cache,
                   const KernelSource& source);

    vk::raii::DescriptorSetLayout descriptorSetLayout;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline pipeline = nullptr;
};

// Keeps the kernels that were used last: a driver may take half a second to compile one, even with its cache.
class CompiledKernels {
  public:
    // Returns the kernel. If it is not kept, compiles it and saves the cache. Throws vk::SystemError.
    std::shared_ptr<const CompiledKernel> compile(const vk::raii::Device& device, PipelineCache& cache,
                                                  KernelSource source);

  private:
    static constexpr std::size_t kMost = 32;

    std::list<std::pair<KernelSource, std::shared_ptr<const CompiledKernel>>>
        kept_; // the last used one is first
};

} // namespace metamarch::vulkan
