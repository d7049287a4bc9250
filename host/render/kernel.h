// SPDX-License-Identifier: MIT
// Creates pipelines of kernels that read no scene.
#pragma once
#include "metamarch/vulkan/compute_pipeline.h"

#include <string_view>

namespace metamarch::render {

// Returns the pipeline of the embedded kernel `name`, which must exist. `own` lists all of its bindings.
vulkan::ComputePipeline makeKernel(const vulkan::Device& device, std::string_view name,
                                   vulkan::KernelInfo own);

} // namespace metamarch::render
