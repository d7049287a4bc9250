// SPDX-License-Identifier: MIT
// Kernels that read no scene.
#pragma once
#include "metamarch/vulkan/compute_pipeline.h"

#include <string_view>

namespace metamarch::render {

// The kernel of that name in the program, which is there. `own` is all it has.
vulkan::ComputePipeline makeKernel(const vulkan::Device& device, std::string_view name,
                                   vulkan::KernelInfo own);

} // namespace metamarch::render
