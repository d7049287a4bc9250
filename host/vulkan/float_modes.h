// SPDX-License-Identifier: MIT
// How a kernel's float operations behave where a device lets us choose.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::vulkan {

// What a device offers for floats of 32 bits. Without these modes it may round in any direction, take -0 for
// 0, and assume that no value is infinite or NaN.
struct FloatModes {
    bool roundsToNearestEven = false;
    bool keepsSignsInfinitiesAndNans = false;
};

// Returns the module with these execution modes at its entry point. The modules of shaders/ are made for
// every device, so they ask for none.
std::vector<uint32_t> withFloatModes(std::span<const uint32_t> spirv, const FloatModes& modes);

} // namespace metamarch::vulkan
