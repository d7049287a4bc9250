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

// Returns those whose instructions this processor has. A kernel's name ends with its set of instructions.
std::vector<ProcessorKernel> executable(std::vector<ProcessorKernel> kernels);

// Each of these returns kernels that this processor can execute, the fastest first. All of them walk the meta
// table, and all give the same bits.

// kernels/path.glsl. `features` are those of the scene and the camera (shared/features.h).
std::vector<ProcessorKernel> pathKernels(std::uint32_t features);

// kernels/primary.glsl
std::vector<ProcessorKernel> primaryKernels();

// kernels/rays.glsl
std::vector<ProcessorKernel> rayKernels();

} // namespace metamarch
