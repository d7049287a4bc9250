#include "vulkan/compute_pipeline.h"

#include "error.h"
#include "vulkan/byte_text.h"
#include "vulkan/refusal.h"

#include <fmt/format.h>

#include <utility>

namespace metamarch::vulkan {
namespace {

void requireLimits(const DeviceReport& device, const KernelInfo& info) {
    const auto require = [&](const char* limit, uint32_t has, size_t needs) {
        if (needs > has) {
            throw Error(ExitCode::noDevice, fmt::format("{}: {} {}, kernel '{}' needs {}", device.name, limit,
                                                        has, info.name, needs));
        }
    };
    require("maxPerStageDescriptorStorageBuffers", device.maxPerStageDescriptorStorageBuffers,
            info.storageBindings.size());
    require("maxPushConstantsSize", device.maxPushConstantsSize, info.pushConstantSize);
}

} // namespace

ComputePipeline::ComputePipeline(const Device& device, const KernelInfo& info)
    : device_(&device), name_(info.name), pushConstantSize_(info.pushConstantSize) {
    requireLimits(device.report(), info);
    try {
        createDescriptorSet(info.storageBindings);
        createPipeline(info);
    } catch (const vk::SystemError& error) {
        throw refusalOf(error, fmt::format("{}: cannot make kernel '{}'", device.name(), name_));
    }
}

void ComputePipeline::createDescriptorSet(const std::vector<uint32_t>& storageBindings) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const uint32_t binding : storageBindings) {
        bindings.emplace_back(binding, vk::DescriptorType::eStorageBuffer, 1,
                              vk::ShaderStageFlagBits::eCompute);
    }
    const vk::raii::Device& device = device_->handle();
    descriptorSetLayout_ = {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};

    std::vector<vk::DescriptorPoolSize> sizes;
    if (!bindings.empty()) { // Vulkan has no pool sizes of 0
        sizes.emplace_back(vk::DescriptorType::eStorageBuffer, static_cast<uint32_t>(bindings.size()));
    }
    // The RAII set frees itself, which a pool allows only with this flag.
    descriptorPool_ = {
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
    vk::raii::DescriptorSets sets(device, {*descriptorPool_, *descriptorSetLayout_});
    descriptorSet_ = std::move(sets.front());
}

void ComputePipeline::createPipeline(const KernelInfo& info) {
    const vk::PushConstantRange pushConstants(vk::ShaderStageFlagBits::eCompute, 0, pushConstantSize_);
    vk::PipelineLayoutCreateInfo layoutInfo({}, *descriptorSetLayout_);
    if (pushConstantSize_ != 0) {
        layoutInfo.setPushConstantRanges(pushConstants);
    }
    const vk::raii::Device& device = device_->handle();
    pipelineLayout_ = {device, layoutInfo};

    std::vector<vk::SpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    for (const auto& [constantId, value] : info.specialization) {
        entries.emplace_back(constantId, static_cast<uint32_t>(values.size() * sizeof value), sizeof value);
        values.push_back(value);
    }
    const vk::SpecializationInfo specialization(static_cast<uint32_t>(entries.size()), entries.data(),
                                                values.size() * sizeof(uint32_t), values.data());
    const vk::raii::ShaderModule module(device, {{}, info.spirv.size_bytes(), info.spirv.data()});
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &specialization);
    pipeline_ = {device, device_->pipelineCache(),
                 vk::ComputePipelineCreateInfo({}, stage, *pipelineLayout_)};
}

void ComputePipeline::bind(uint32_t binding, const Buffer& buffer) {
    const uint64_t range = device_->report().maxStorageBufferRange;
    if (buffer.size() > range) {
        throw Error(ExitCode::outOfMemory,
                    fmt::format("{}: buffer '{}' of {} is over maxStorageBufferRange, {}", device_->name(),
                                buffer.name(), byteText(buffer.size()), byteText(range)));
    }
    const vk::DescriptorBufferInfo bufferInfo(buffer.handle(), 0, VK_WHOLE_SIZE);
    device_->handle().updateDescriptorSets(vk::WriteDescriptorSet(*descriptorSet_, binding, 0,
                                                                  vk::DescriptorType::eStorageBuffer, {},
                                                                  bufferInfo),
                                           {});
}

} // namespace metamarch::vulkan
