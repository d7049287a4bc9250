// SPDX-License-Identifier: MIT
// Binds a scene to the kernels that the processor executes (shaders/processor).
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/processor/kernel_input.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace metamarch::render {

// Returns an input with what the march through the meta table reads. The structure must outlive it. Throws
// Error(outOfMemory) if an array has more than 4 GiB.
KernelInput inputOver(const AccelerationStructure& structure);

// Binds values that the kernel reads, and that must outlive the input. Throws Error(outOfMemory) for more
// than 4 GiB.
void bindBytes(KernelInput& input, std::uint32_t binding, std::span<const std::byte> bytes);
template <class T>
void bindValues(KernelInput& input, const std::uint32_t binding, const std::span<const T> values) {
    bindBytes(input, binding, std::as_bytes(values));
}

// Binds values that the kernel writes.
template <class T>
void bindOutput(KernelInput& input, const std::uint32_t binding, T* const values) {
    input.buffers[binding] = reinterpret_cast<char*>(values);
}

// Returns the input with other push constants, which must outlive it.
template <class Push>
KernelInput withPush(KernelInput input, const Push& push) {
    input.push = reinterpret_cast<const char*>(&push);
    return input;
}

} // namespace metamarch::render
