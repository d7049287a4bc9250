// SPDX-License-Identifier: MIT
// The two chunks of a .glb file (glTF 2.0, section 4.4).
#pragma once
#include "metamarch/file/input_file.h"

#include <cstddef>
#include <vector>

namespace metamarch {

struct ByteRange {
    std::size_t begin = 0;
    std::size_t end = 0; // exclusive
};

bool isGlb(const std::vector<unsigned char>& bytes);

struct GlbChunks {
    ByteRange json;
    ByteRange binary; // empty if there is none
};

// Returns where the chunks lie. Throws Error(inputRefused) if the lengths of header and chunks do not agree
// with the file's size. Bytes behind the declared length and later chunks are ignored.
GlbChunks glbChunks(const InputFile& file, const std::vector<unsigned char>& bytes);

} // namespace metamarch
