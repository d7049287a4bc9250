// SPDX-License-Identifier: MIT
// Chooses the device to run on.
#pragma once
#include "metamarch/vulkan/device_report.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace metamarch::vulkan {

// Returns the index of the default device: discrete before integrated, virtual, cpu and other; the first
// among equals. Returns nothing if no device is usable.
std::optional<uint32_t> defaultDevice(std::span<const DeviceReport> reports);

// Returns the index of the device that `selection` (--device) names. Empty means the default device; digits
// only mean that index; anything else is a part of the name, in any case, that must match exactly one usable
// device. Throws Error(noDevice), listing the devices and why they are refused.
uint32_t chooseDevice(std::span<const DeviceReport> reports, const std::string& selection);

} // namespace metamarch::vulkan
