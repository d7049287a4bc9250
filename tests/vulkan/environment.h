// What the tests of this folder share: one context and one device, under validation.
#pragma once
#include "vulkan/device.h"

namespace metamarch::vulkan {

// Opened at the start of the program; without a device every test fails. METAMARCH_VALIDATION is 1 and the
// user's pipeline cache stays untouched.
const Context& testContext();
const Device& testDevice();

} // namespace metamarch::vulkan
