// SPDX-License-Identifier: MIT
// Makes a kernel's float operations return the same bits on every device that lets us choose.
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

    bool operator==(const FloatModes&) const = default;
};

// Returns the module with NoContraction at every float operation, so that a driver may neither fuse nor
// reorder them, and with these modes at its entry point. The modules of shaders/ have none of it: they are
// made for every device, and glslang 12 may search without end for what a `precise` reaches. `spirv` has no
// such decoration yet. A damaged module comes back as it is: the driver refuses it.
std::vector<uint32_t> withExactFloats(std::span<const uint32_t> spirv, const FloatModes& modes);

} // namespace metamarch::vulkan
