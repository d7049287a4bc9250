// SPDX-License-Identifier: MIT
// Chooses the device to run on.
#pragma once
#include "metamarch/vulkan/device_report.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace metamarch::vulkan {

// Returns the index of the default device: one that runs every kernel before others, then discrete before
// integrated, virtual, cpu and other; the first among equals. Returns nothing if no device is usable.
std::optional<uint32_t> defaultDevice(std::span<const DeviceReport> reports);

// Returns the index of the device that `selection` names. An empty text names the default device, a text of
// digits the device with that index. Any other text must be a part of the name of exactly one usable device;
// upper and lower case are equal. Throws Error(noDevice), listing the devices and why they are refused.
uint32_t chooseDevice(std::span<const DeviceReport> reports, const std::string& selection);

} // namespace metamarch::vulkan
