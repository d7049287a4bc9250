// SPDX-License-Identifier: MIT
// The bindings and constants of kernels/affine.comp, and functions that create it.
#pragma once
#include "metamarch/vulkan/compute_pipeline.h"

#include <cstdint>

namespace metamarch::vulkan {

#include "kernels/affine.h" // made by glslangValidator: const uint32_t affineSpirv[]

inline constexpr uint32_t kAffineInputs = 1;
inline constexpr uint32_t kAffineOutputs = 4;
inline constexpr uint32_t kAffineFactor = 7; // constant_id of the kernel's factor

struct AffinePush {
    uint32_t offset;
    uint32_t count;
};

inline KernelInfo affineInfo(uint32_t factor = 1) {
    return {.name = "affine",
            .spirv = affineSpirv,
            .storageBindings = {kAffineInputs, kAffineOutputs},
            .pushConstantSize = sizeof(AffinePush),
            .specialization = {{kAffineFactor, factor}}};
}

inline ComputePipeline affineKernel(const Device& device, uint32_t factor) {
    return ComputePipeline(device, affineInfo(factor));
}

} // namespace metamarch::vulkan
