// Vulkan's error codes as the project's Error.
#pragma once
#include "metamarch/error/error.h"

#include <vulkan/vulkan.hpp>

#include <string>

namespace metamarch::vulkan {

// `what` and the driver's words; outOfMemory for the codes that say so, noDevice for a lost device and the
// rest.
Error refusalOf(const vk::SystemError& error, const std::string& what);

} // namespace metamarch::vulkan
