// SPDX-License-Identifier: MIT
// Checks mesh files completely before Assimp reads them. Assimp takes a truncated file for a small one, reads
// past the end of a truncated binary PLY, and does not check face indices.
#pragma once
#include "metamarch/file/input_file.h"

#include <cstdint>
#include <string_view>

namespace metamarch {

struct MeshCounts {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
};

// Both throw Error(inputRefused) unless header and body agree to the last element, every number can be parsed
// and every face index is in range. Assimp must arrive at the counts that they return.
MeshCounts checkPly(const InputFile& file, std::string_view bytes);
MeshCounts checkOff(const InputFile& file, std::string_view bytes);

// Throws Error(inputRefused) for a text file without its end marker. Assimp itself notices truncated binary
// files.
void checkStl(const InputFile& file, std::string_view bytes);

} // namespace metamarch
