// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/refusal.h"

#include <fmt/format.h>

namespace metamarch::vulkan {

Error refusalOf(const vk::SystemError& error, const std::string& what) {
    const bool memory = error.code() == vk::Result::eErrorOutOfDeviceMemory ||
                        error.code() == vk::Result::eErrorOutOfHostMemory;
    return {memory ? ErrorKind::outOfMemory : ErrorKind::noDevice,
            fmt::format("{} ({})", what, error.what())};
}

} // namespace metamarch::vulkan
