// SPDX-License-Identifier: MIT
// The header of a PLY file.
#pragma once
#include "metamarch/file/input_file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch {

enum class PlyEncoding { text, littleEndian, bigEndian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t sizeOf(PlyType type);
constexpr bool isFraction(PlyType type) { return type == PlyType::float32 || type == PlyType::float64; }

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::int32;
    std::optional<PlyType> countType; // set for a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::text;
    std::vector<PlyElement> elements;
    std::vector<std::string> textureFiles;    // `comment TextureFile NAME`, in file order
    std::optional<std::uint64_t> gridColumns; // `obj_info num_cols N`
    std::optional<std::uint64_t> gridRows;
    std::string_view body;

    // Returns null if there is no such element.
    const PlyElement* find(std::string_view name) const;
};

// Throws Error(inputRefused) if the header is broken, or announces more than `bytes` can hold.
PlyHeader readPlyHeader(const InputFile& file, std::string_view bytes);

} // namespace metamarch
