// SPDX-License-Identifier: MIT
// Formats byte counts for messages and reports.
#pragma once
#include <cstdint>
#include <string>

namespace metamarch::vulkan {

// Returns a text such as "17 bytes", "128.0 MiB" or "2.5 GiB".
std::string byteText(uint64_t bytes);

} // namespace metamarch::vulkan
