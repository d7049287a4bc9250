// SPDX-License-Identifier: MIT
// Traversals that a driver ended before they were done.
#pragma once
#include "metamarch/vulkan/device.h"

#include <cstdint>
#include <string>

namespace metamarch::render {

// Throws Error(outOfMemory), naming the limit, where a traversal reports kCutShort in place of its steps.
void refuseCutShort(std::uint32_t steps, const vulkan::Device& device, const std::string& traversal);

} // namespace metamarch::render
