// Byte counts as messages and reports write them.
#pragma once
#include <cstdint>
#include <string>

namespace metamarch::vulkan {

// "17 bytes", "128.0 MiB", "2.5 GiB".
std::string byteText(uint64_t bytes);

} // namespace metamarch::vulkan
