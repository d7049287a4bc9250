// SPDX-License-Identifier: MIT
// Rewrites a kernel for a driver whose time to compile doubles with each `else`.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::vulkan {

// Returns the module with `if (c) {a}; if (!c) {b}` in place of `if (c) {a} else {b}`. The kernel computes
// the same. SwiftShader asks for each loop which blocks its header reaches (Spirv::Function::ExistsPath). It
// walks breadth first and marks a block as seen when it leaves the queue, so a block is in there once for
// each shortest way to it. Every `else` doubles these ways: the loop of the path tracer has 10^23 of them,
// and 17,000 without. A selection whose blocks are not in glslang's order stays as it is, and so does one
// whose merge block begins with OpPhi, and a damaged module.
std::vector<uint32_t> withoutElseBranches(std::span<const uint32_t> spirv);

} // namespace metamarch::vulkan
