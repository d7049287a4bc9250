// SPDX-License-Identifier: MIT
#include "metamarch/render/shading_buffers.h"

#include "metamarch/render/shading_arrays.h"
#include "metamarch/vulkan/transfer.h"

namespace metamarch::render {
namespace {

// Bindings whose entries are single words; all others have four.
bool isTexels(const std::uint32_t binding) {
    return binding >= kBindTexels && binding < kBindTexels + kTexelChunks;
}

} // namespace

ShadingBuffers::ShadingBuffers(const vulkan::Device& device, const ShadingScene& scene)
    : features(scene.features) {
    const ShadingArrays arrays(scene);
    for (const ShadingArray& array : arrays.arrays()) {
        buffers.emplace(array.binding, vulkan::upload(device, array.data, array.name));
    }
}

void ShadingBuffers::addTo(vulkan::KernelInfo& kernel, const std::uint32_t ofCamera) const {
    for (const auto& [binding, buffer] : buffers) {
        kernel.texelBindings.emplace(binding,
                                     isTexels(binding) ? VK_FORMAT_R32_UINT : VK_FORMAT_R32G32B32A32_UINT);
    }
    kernel.specialization[kSpecFeatures] = features | ofCamera;
}

void ShadingBuffers::bindTo(vulkan::ComputePipeline& pipeline) const {
    for (const auto& [binding, buffer] : buffers) {
        pipeline.bind(binding, buffer);
    }
}

std::uint64_t ShadingBuffers::bytes() const {
    std::uint64_t total = 0;
    for (const auto& [binding, buffer] : buffers) {
        total += buffer.size();
    }
    return total;
}

} // namespace metamarch::render
