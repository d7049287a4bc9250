// SPDX-License-Identifier: MIT
// Checks PNG chunks before libpng reads them, because libpng writes its complaints to stderr.
#pragma once
#include <span>

namespace metamarch {

// Throws TextureFailure unless the chunks of the PNG are complete, contiguous and have correct checksums up
// to the last one (Portable Network Graphics Specification, third edition, 5).
void checkPng(std::span<const unsigned char> bytes);

} // namespace metamarch
