// PNG chunks, checked before a library sees them: libpng writes its complaints to stderr.
#pragma once
#include <span>

namespace metamarch {

// Throws TextureFailure unless the chunks of a PNG lie whole, one behind the other, with the right check sums
// up to the last (Portable Network Graphics Specification, third edition, 5).
void checkPng(std::span<const unsigned char> bytes);

} // namespace metamarch
