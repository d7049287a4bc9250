// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/compiled_kernel.h"

#include "metamarch/vulkan/dead_branches.h"
#include "metamarch/vulkan/else_branches.h"
#include "metamarch/vulkan/initializers.h"

#include <algorithm>

namespace metamarch::vulkan {
namespace {

vk::raii::DescriptorSetLayout setLayoutOf(const vk::raii::Device& device, const KernelSource& source) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    bindings.reserve(source.bindings.size());
    for (const auto& [binding, type] : source.bindings) {
        bindings.emplace_back(binding, type, 1, vk::ShaderStageFlagBits::eCompute);
    }
    return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

} // namespace

CompiledKernel::CompiledKernel(const vk::raii::Device& device, const vk::raii::PipelineCache& cache,
                               const KernelSource& source)
    : descriptorSetLayout(setLayoutOf(device, source)) {
    const vk::PushConstantRange pushConstants(vk::ShaderStageFlagBits::eCompute, 0, source.pushConstantSize);
    vk::PipelineLayoutCreateInfo layoutInfo({}, *descriptorSetLayout);
    if (source.pushConstantSize != 0) {
        layoutInfo.setPushConstantRanges(pushConstants);
    }
    layout = {device, layoutInfo};

    std::vector<vk::SpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    for (const auto& [constantId, value] : source.specialization) {
        entries.emplace_back(constantId, static_cast<uint32_t>(values.size() * sizeof value), sizeof value);
        values.push_back(value);
    }
    const vk::SpecializationInfo specialization(static_cast<uint32_t>(entries.size()), entries.data(),
                                                values.size() * sizeof(uint32_t), values.data());
    std::vector<uint32_t> spirv =
        withExactFloats(withoutDeadBranches(source.spirv, source.specialization), source.floatModes);
    if (source.simplifiesBranches) {
        spirv = withInitializers(withoutElseBranches(spirv));
    }
    const vk::raii::ShaderModule module(device, {{}, spirv.size() * sizeof(uint32_t), spirv.data()});
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &specialization);
    pipeline = {device, cache, vk::ComputePipelineCreateInfo({}, stage, *layout)};
}

std::shared_ptr<const CompiledKernel> CompiledKernels::compile(const vk::raii::Device& device,
                                                               PipelineCache& cache, KernelSource source) {
    const auto found = std::ranges::find_if(kept_, [&](const auto& kept) { return kept.first == source; });
    if (found != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, found);
    } else {
        auto kernel = std::make_shared<const CompiledKernel>(device, cache.handle(), source);
        cache.save();
        kept_.emplace_front(std::move(source), std::move(kernel));
        if (kept_.size() > kMost) {
            kept_.pop_back();
        }
    }
    return kept_.front().second;
}

} // namespace metamarch::vulkan
