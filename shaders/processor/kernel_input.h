// SPDX-License-Identifier: MIT
// What a kernel reads and writes when the processor executes it.
#pragma once
#include <cstdint>

namespace metamarch {

struct KernelInput {
    static constexpr unsigned kLanes = 8; // invocations that are executed at once
    static constexpr unsigned kBindings = 64;
    static constexpr unsigned kConstants = 8;

    // [binding] Each has at least one entry. The kernel also writes to those that its shader declares
    // writable.
    char* buffers[kBindings];
    const char* push; // the push constants
    // [SpecId] values of the specialization constants
    std::uint32_t constants[kConstants];
    std::uint32_t workgroup;   // its x; y and z are 0
    std::uint32_t invocations; // of a workgroup; a multiple of kLanes
};

using Kernel = void (*)(const KernelInput& input);

} // namespace metamarch
