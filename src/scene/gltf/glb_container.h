// The two chunks of a .glb (glTF 2.0, section 4.4).
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

// Where the JSON lies. Throws Error(inputRefused) unless header and chunk lengths agree with the file's size;
// bytes behind the declared length are cut off.
ByteRange glbJson(const InputFile& file, std::vector<unsigned char>& bytes);

// Puts other JSON in its place and mends the lengths.
void replaceGlbJson(const InputFile& file, std::vector<unsigned char>& bytes, ByteRange json,
                    const std::string& text);

} // namespace metamarch
