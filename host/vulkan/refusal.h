// SPDX-License-Identifier: MIT
// Converts Vulkan's error codes to Error.
#pragma once
#include "metamarch/error/error.h"
#include "metamarch/vulkan/handle_types.h"

#include <optional>
#include <string>
#include <system_error>

namespace metamarch::vulkan {

// Returns an Error with the text `what` and the driver's words. Its kind is outOfMemory for the out-of-memory
// codes and noDevice for a lost device and all others.
Error refusalOf(const vk::SystemError& error, const std::string& what);
// Likewise, for an error that may be Vulkan's; nothing if it is not.
std::optional<Error> refusalOf(const std::system_error& error, const std::string& what);

// What a limit on the process's addresses (`ulimit -v`) may have to do with a failure, to be put behind its
// text; empty without a limit.
std::string addressLimitText();

// Throws Error(outOfMemory) where such a limit leaves less than drivers need: they end the program when they
// get no memory.
void checkAddressLimit();

} // namespace metamarch::vulkan
