// SPDX-License-Identifier: MIT
// Refuses results of traversals that the driver ended early.
#pragma once
#include "metamarch/vulkan/device.h"

#include <cstdint>
#include <string>

namespace metamarch::render {

// Throws Error(outOfMemory), naming the limit, if `steps` is kCutShort: the traversal did not finish.
void refuseCutShort(std::uint32_t steps, const vulkan::Device& device, const std::string& traversal);

} // namespace metamarch::render
