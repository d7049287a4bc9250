// SPDX-License-Identifier: MIT
// Divisions that are off by 2 ulp, as Vulkan allows them to be, for a driver that divides exactly.
#pragma once
#include <cstdint>
#include <vector>

// Returns the module with each quotient of 32-bit floats moved by -2, 0 or 2 ulp, as its own bits say. 0,
// infinity and NaN stay.
std::vector<std::uint32_t> withRoughDivision(const std::vector<std::uint32_t>& spirv);
