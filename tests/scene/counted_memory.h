// SPDX-License-Identifier: MIT
// Replaces operator new in a test program, and counts. Under AddressSanitizer it counts nothing.
#pragma once
#include <cstddef>

namespace metamarch {

// The bytes that operator new has given and operator delete has not taken back.
std::size_t bytesInUse();

// The most that were in use since the last call of watchMemory().
std::size_t mostBytesInUse();
void watchMemory();

} // namespace metamarch
