// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/byte_text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace metamarch::vulkan {

std::string byteText(uint64_t bytes) {
    constexpr std::array kUnits = {"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    if (bytes < 1024) {
        return fmt::format("{} bytes", bytes);
    }
    double value = static_cast<double>(bytes) / 1024.0;
    size_t unit = 0;
    while (value >= 1024.0) { // 2^64 bytes are 16 EiB, so the value ends before the table of units does
        value /= 1024.0;
        ++unit;
    }
    return fmt::format("{:.1f} {}", value, kUnits[unit]);
}

} // namespace metamarch::vulkan
