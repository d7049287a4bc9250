// SPDX-License-Identifier: MIT
// Kernels that the processor executes, eight invocations at once. They are made of the shaders: see
// README.md.
#pragma once
#include "metamarch/processor/kernel_input.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace metamarch {

struct ProcessorKernel {
    std::string_view name; // with its set of instructions
    Kernel run;
};

// Returns the path tracers over the meta table (kernels/path.glsl) that this processor can execute, the
// fastest first. All draw the same. `features` are those of the scene and the camera (shared/features.h).
std::vector<ProcessorKernel> pathKernels(std::uint32_t features);

} // namespace metamarch
