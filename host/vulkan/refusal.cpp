#include "vulkan/refusal.h"

#include <fmt/format.h>

namespace metamarch::vulkan {

Error refusalOf(const vk::SystemError& error, const std::string& what) {
    const bool memory = error.code() == vk::Result::eErrorOutOfDeviceMemory ||
                        error.code() == vk::Result::eErrorOutOfHostMemory;
    return {memory ? ExitCode::outOfMemory : ExitCode::noDevice, fmt::format("{} ({})", what, error.what())};
}

} // namespace metamarch::vulkan
