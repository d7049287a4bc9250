// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mesh_check.h"

#include <cstring>

namespace metamarch {

void checkStl(const InputFile& file, std::string_view bytes) {
    constexpr std::size_t kHeaderSize = 80;
    constexpr std::uint64_t kFacetSize = 50;
    std::uint32_t facets = 0;
    if (bytes.size() >= kHeaderSize + sizeof facets) {
        std::memcpy(&facets, bytes.data() + kHeaderSize, sizeof facets);
    }
    // A binary header may start with "solid" too; the file's size then shows that it is binary.
    const bool isBinary = bytes.size() >= kHeaderSize + sizeof facets + kFacetSize * facets && facets > 0;
    if (!isBinary && bytes.starts_with("solid") && bytes.rfind("endsolid") == std::string_view::npos) {
        file.refuse("STL text is cut off: there is no endsolid");
    }
}

} // namespace metamarch
