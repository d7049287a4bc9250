// SPDX-License-Identifier: MIT
// The two chunks of a .glb file (glTF 2.0, section 4.4).
#pragma once
#include "metamarch/file/input_file.h"

#include <cstddef>
#include <string>
#include <vector>

namespace metamarch {

struct ByteRange {
    std::size_t begin = 0;
    std::size_t end = 0; // exclusive
};

bool isGlb(const std::vector<unsigned char>& bytes);

// Returns where the JSON lies. Throws Error(inputRefused) if the lengths of header and chunks do not agree
// with the file's size. Cuts off bytes behind the declared length.
ByteRange glbJson(const InputFile& file, std::vector<unsigned char>& bytes);

// Replaces the JSON by `text` and updates the lengths.
void replaceGlbJson(const InputFile& file, std::vector<unsigned char>& bytes, ByteRange json,
                    const std::string& text);

} // namespace metamarch
