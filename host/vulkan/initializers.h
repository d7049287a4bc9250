// SPDX-License-Identifier: MIT
// Gives each local variable of a kernel a value to begin with, for a driver that looks for one in vain.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::vulkan {

// Returns the module with zero as the initializer of each variable of a function that has none. The kernel
// computes the same. SwiftShader copies all functions into the main one, where a variable without initializer
// is one variable for all turns of a loop. Where a branch reads it that does not write it, SPIRV-Tools (SSA
// rewriting) looks for its value through the whole loop, and makes an instruction for each of the loop's
// blocks on the way. So the path tracer takes up to 4.6 million ids, and SPIRV-Tools ends at 4.2 million. A
// copy of a function writes the initializers first, so the search ends there. A variable stays as it is whose
// type has no zero, and so does a damaged module.
std::vector<uint32_t> withInitializers(std::span<const uint32_t> spirv);

} // namespace metamarch::vulkan
