// SPDX-License-Identifier: MIT
// The attribute codec and the color filter of KHR_meshopt_compression, which Debian's meshoptimizer (0.18)
// does not have: it reads version 0 of the codec only.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace metamarch {

// Decodes `count` elements of `stride` bytes, a multiple of 4 up to 256, in either version of the codec
// (appendix A, mode 0). Returns nothing if the stream is not valid.
std::optional<std::vector<unsigned char>> decodeMeshoptAttributes(std::span<const unsigned char> stream,
                                                                  std::uint64_t count, std::uint64_t stride);

// Turns YCoCg into RGBA in place (appendix B, filter 4). `stride` is 4 for components of 8 bits and 8 for 16.
void decodeMeshoptColors(std::span<unsigned char> bytes, std::uint64_t stride);

} // namespace metamarch
