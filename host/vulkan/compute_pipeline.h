// SPDX-License-Identifier: MIT
// A compute kernel with its bindings: storage, texel and uniform buffers, all in descriptor set 0.
#pragma once
#include "metamarch/error/error.h"
#include "metamarch/vulkan/box_hierarchy.h"
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/device.h"
#include "metamarch/vulkan/handle_types.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace metamarch::vulkan {

// Everything that a ComputePipeline is made from.
struct KernelInfo {
    std::string name{};                      // for error messages
    std::span<const uint32_t> spirv{};       // entry point "main"; used only while the pipeline is created
    std::vector<uint32_t> storageBindings{}; // binding numbers in set 0, in any order
    std::vector<uint32_t> uniformBindings{}; // likewise, for small constants that all invocations read
    std::map<uint32_t, VkFormat> texelBindings{}; // binding number to texel format
    std::vector<uint32_t> hierarchyBindings{};    // likewise, for box hierarchies
    uint32_t pushConstantSize = 0;                // bytes; 0: none
    // Maps constant_id to the 32 bits of its value (std::bit_cast a float or an int).
    std::map<uint32_t, uint32_t> specialization{};
};

// A buffer is larger than what the device lets a shader see. The kind is ErrorKind::outOfMemory.
class BindingOverLimit : public Error {
  public:
    explicit BindingOverLimit(const std::string& line) : Error(ErrorKind::outOfMemory, line) {}
};

// Move-only. Drivers may postpone compilation to the first dispatch (lavapipe does), so warm up before
// timing.
class ComputePipeline {
  public:
    // Throws Error(noDevice) if the device allows fewer storage buffers or push constants than the kernel
    // needs, or cannot compile it.
    ComputePipeline(const Device& device, const KernelInfo& info);
    ~ComputePipeline();
    ComputePipeline(ComputePipeline&&) noexcept;
    ComputePipeline& operator=(ComputePipeline&&) noexcept;

    // Binds the whole of `buffer` to `binding`. Must not be called while a Submission that uses this pipeline
    // is running; the buffer must outlive the last such submission. Throws BindingOverLimit.
    void bind(uint32_t binding, const Buffer& buffer);
    void bind(uint32_t binding, const BoxHierarchy& hierarchy);

    const std::string& name() const { return name_; }
    uint32_t pushConstantSize() const { return pushConstantSize_; }
    vk::Pipeline handle() const;
    vk::PipelineLayout layout() const;
    vk::DescriptorSet descriptorSet() const;

  private:
    struct Handles;

    void createDescriptorSet();
    void bindTexels(uint32_t binding, const Buffer& buffer);

    const Device* device_;
    std::string name_;
    uint32_t pushConstantSize_;
    std::map<uint32_t, VkFormat> texelFormats_;
    std::unique_ptr<Handles> handles_;
};

} // namespace metamarch::vulkan
