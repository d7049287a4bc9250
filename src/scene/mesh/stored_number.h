// SPDX-License-Identifier: MIT
// Numbers of binary files.
#pragma once
#include <bit>
#include <cstddef>
#include <cstring>

namespace metamarch {

// Returns the number whose bytes, in this order, begin at `bytes`. Bits is an unsigned integer.
template <class Bits, std::endian order>
Bits storedNumber(const char* bytes) {
    Bits number = 0;
    if constexpr (order == std::endian::native) {
        std::memcpy(&number, bytes, sizeof number);
    } else {
        for (std::size_t i = 0; i < sizeof number; ++i) {
            number = static_cast<Bits>(number << 8 | static_cast<unsigned char>(bytes[i]));
        }
    }
    return number;
}

} // namespace metamarch
