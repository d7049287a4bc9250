// SPDX-License-Identifier: MIT
// Checks PNG chunks before libpng reads them, because libpng writes its complaints to stderr.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace metamarch {

struct MendedPng {
    std::vector<unsigned char> bytes; // the mended file; empty if nothing was wrong
    std::string flaw;                 // "has no end mark"; empty if nothing was wrong
};

// Throws TextureFailure unless the chunks of the PNG are complete, contiguous and have correct checksums up
// to the last one (Portable Network Graphics Specification, third edition, 5). Two flaws change no texel and
// are mended: a missing last chunk, and a wrong checksum of an ancillary chunk, which is left out.
MendedPng mendPng(std::span<const unsigned char> bytes);

} // namespace metamarch
