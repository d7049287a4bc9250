// Which device to run on.
#pragma once
#include "metamarch/vulkan/device_report.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace metamarch::vulkan {

// The index of the device to use without a selection: discrete before integrated, virtual, cpu and other; the
// first of equals. Nothing when no device is usable.
std::optional<uint32_t> defaultDevice(std::span<const DeviceReport> reports);

// The index of the device `selection` names (--device). Empty: the default one. Only digits: that index.
// Otherwise a part of the name, in any case, that must fit exactly one usable device.
// Throws Error(noDevice), whose line lists the devices with their refusals.
uint32_t chooseDevice(std::span<const DeviceReport> reports, const std::string& selection);

} // namespace metamarch::vulkan
