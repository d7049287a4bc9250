// SPDX-License-Identifier: MIT
#include "metamarch/render/kernel.h"

#include "metamarch/shaders/shader_library.h"

#include <algorithm>
#include <string>

namespace metamarch::render {

vulkan::ComputePipeline makeKernel(const vulkan::Device& device, const std::string_view name,
                                   vulkan::KernelInfo own) {
    own.name = std::string(name);
    own.spirv = std::ranges::find(shaders(), name, &Shader::kernel)->spirv;
    return {device, own};
}

} // namespace metamarch::render
