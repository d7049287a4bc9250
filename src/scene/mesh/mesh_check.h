// Mesh files read to their end before Assimp sees them: it takes a cut-off file for a small one, reads past
// the end of a cut-off binary PLY, and does not look at face indices.
#pragma once
#include "metamarch/file/input_file.h"

#include <cstdint>
#include <string_view>

namespace metamarch {

struct MeshCounts {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
};

// Both throw Error(inputRefused) unless header and body agree to the last element, every number can be read
// and every face index is in range. The counts are what Assimp must arrive at.
MeshCounts checkPly(const InputFile& file, std::string_view bytes);
MeshCounts checkOff(const InputFile& file, std::string_view bytes);

// Throws Error(inputRefused) for a text without its end; binary files are cut off where Assimp notices.
void checkStl(const InputFile& file, std::string_view bytes);

} // namespace metamarch
