// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/compute_pipeline.h"

#include "metamarch/error/error.h"
#include "metamarch/vulkan/byte_text.h"
#include "metamarch/vulkan/compiled_kernel.h"
#include "metamarch/vulkan/refusal.h"

#include <fmt/format.h>
#include <vulkan/vulkan_format_traits.hpp>
#include <vulkan/vulkan_raii.hpp>

#include <utility>

namespace metamarch::vulkan {
namespace {

// The size of uniform bindings in bytes: the smallest maxUniformBufferRange that Vulkan allows, and far more
// than the constants of any kernel.
constexpr uint64_t kUniformRange = 16384;

void requireLimits(const DeviceReport& device, const KernelInfo& info) {
    const auto require = [&](const char* limit, uint32_t has, size_t needs) {
        if (needs > has) {
            throw Error(ErrorKind::noDevice, fmt::format("{}: {} {}, kernel '{}' needs {}", device.name,
                                                         limit, has, info.name, needs));
        }
    };
    require("maxPerStageDescriptorStorageBuffers", device.maxPerStageDescriptorStorageBuffers,
            info.storageBindings.size());
    require("maxPerStageDescriptorSampledImages", device.maxPerStageDescriptorSampledImages,
            info.texelBindings.size());
    require("maxPushConstantsSize", device.maxPushConstantsSize, info.pushConstantSize);
}

} // namespace

struct ComputePipeline::Handles {
    std::map<uint32_t, vk::DescriptorType> bindings;
    std::map<uint32_t, vk::raii::BufferView> views;
    std::shared_ptr<const CompiledKernel> kernel; // pipelines of the same kernel share it
    vk::raii::DescriptorPool descriptorPool = nullptr;
    vk::raii::DescriptorSet descriptorSet = nullptr;
};

ComputePipeline::ComputePipeline(const Device& device, const KernelInfo& info)
    : device_(&device), name_(info.name), pushConstantSize_(info.pushConstantSize),
      texelFormats_(info.texelBindings), handles_(std::make_unique<Handles>()) {
    requireLimits(device.report(), info);
    std::map<uint32_t, vk::DescriptorType>& bindings = handles_->bindings;
    for (const uint32_t binding : info.storageBindings) {
        bindings.emplace(binding, vk::DescriptorType::eStorageBuffer);
    }
    for (const uint32_t binding : info.uniformBindings) {
        bindings.emplace(binding, vk::DescriptorType::eUniformBuffer);
    }
    for (const auto& [binding, format] : info.texelBindings) {
        bindings.emplace(binding, vk::DescriptorType::eUniformTexelBuffer);
    }
    for (const uint32_t binding : info.hierarchyBindings) {
        bindings.emplace(binding, vk::DescriptorType::eAccelerationStructureKHR);
    }
    const DeviceReport& report = device.report();
    try {
        handles_->kernel = device.compile({{info.spirv.begin(), info.spirv.end()},
                                           bindings,
                                           pushConstantSize_,
                                           info.specialization,
                                           report.failsWithFloatModes ? FloatModes{} : report.floatModes,
                                           report.compilesBranchesSlowly});
        createDescriptorSet();
    } catch (const vk::SystemError& error) {
        throw refusalOf(error, fmt::format("{}: cannot make kernel '{}'", device.name(), name_));
    }
}

ComputePipeline::~ComputePipeline() = default;
ComputePipeline::ComputePipeline(ComputePipeline&&) noexcept = default;
ComputePipeline& ComputePipeline::operator=(ComputePipeline&&) noexcept = default;

vk::Pipeline ComputePipeline::handle() const { return *handles_->kernel->pipeline; }
vk::PipelineLayout ComputePipeline::layout() const { return *handles_->kernel->layout; }
vk::DescriptorSet ComputePipeline::descriptorSet() const { return *handles_->descriptorSet; }

void ComputePipeline::createDescriptorSet() {
    std::map<vk::DescriptorType, uint32_t> counts;
    for (const auto& [binding, type] : handles_->bindings) {
        ++counts[type];
    }
    std::vector<vk::DescriptorPoolSize> sizes;
    sizes.reserve(counts.size());
    for (const auto& [type, count] : counts) {
        sizes.emplace_back(type, count);
    }
    // The RAII set frees itself, which requires this flag of the pool.
    const vk::raii::Device& device = device_->handle();
    handles_->descriptorPool = {
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
    vk::raii::DescriptorSets sets(device,
                                  {*handles_->descriptorPool, *handles_->kernel->descriptorSetLayout});
    handles_->descriptorSet = std::move(sets.front());
}

void ComputePipeline::bind(uint32_t binding, const Buffer& buffer) {
    const vk::DescriptorType type = handles_->bindings.at(binding);
    if (type == vk::DescriptorType::eUniformTexelBuffer) {
        bindTexels(binding, buffer);
        return;
    }
    const bool uniform = type == vk::DescriptorType::eUniformBuffer;
    const uint64_t range = uniform ? kUniformRange : device_->report().maxStorageBufferRange;
    if (buffer.size() > range) {
        throw BindingOverLimit(fmt::format(
            "{}: buffer '{}' of {} is over {}, {}", device_->name(), buffer.name(), byteText(buffer.size()),
            uniform ? "maxUniformBufferRange" : "maxStorageBufferRange", byteText(range)));
    }
    const vk::DescriptorBufferInfo bufferInfo(buffer.handle(), 0, VK_WHOLE_SIZE);
    device_->handle().updateDescriptorSets(
        vk::WriteDescriptorSet(*handles_->descriptorSet, binding, 0, type, {}, bufferInfo), {});
}

void ComputePipeline::bind(uint32_t binding, const BoxHierarchy& hierarchy) {
    const vk::AccelerationStructureKHR handle = hierarchy.handle();
    const vk::WriteDescriptorSetAccelerationStructureKHR structures(handle);
    vk::WriteDescriptorSet write(*handles_->descriptorSet, binding, 0, 1, handles_->bindings.at(binding));
    write.setPNext(&structures);
    device_->handle().updateDescriptorSets(write, {});
}

void ComputePipeline::bindTexels(uint32_t binding, const Buffer& buffer) {
    const auto format = static_cast<vk::Format>(texelFormats_.at(binding));
    const uint64_t texels = buffer.size() / vk::blockSize(format);
    if (texels > device_->report().maxTexelBufferElements) {
        throw BindingOverLimit(fmt::format("{}: buffer '{}' of {} texels is over maxTexelBufferElements, {}",
                                           device_->name(), buffer.name(), texels,
                                           device_->report().maxTexelBufferElements));
    }
    vk::raii::BufferView view(device_->handle(),
                              vk::BufferViewCreateInfo({}, buffer.handle(), format, 0, VK_WHOLE_SIZE));
    vk::WriteDescriptorSet write(*handles_->descriptorSet, binding, 0, 1,
                                 vk::DescriptorType::eUniformTexelBuffer);
    write.setPTexelBufferView(&*view);
    device_->handle().updateDescriptorSets(write, {});
    handles_->views.insert_or_assign(binding, std::move(view));
}

} // namespace metamarch::vulkan
