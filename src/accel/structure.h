// SPDX-License-Identifier: MIT
// What a traversal walks, declared once: the device gets its arrays from here, and benchmarks what it costs.
#pragma once
#include "metamarch/accel/structure_set.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace metamarch {

// An array as shaders/lib/memory.glsl declares it, or a block of constants. Structures may share it.
struct StructurePart {
    const char* name;
    std::uint32_t binding;
    std::uint32_t words; // of an entry: 1, 2 or 4; 0: constants, which lie in a uniform buffer
    std::span<const std::byte> (*data)(const StructureSet& set);
};

struct Structure {
    std::string_view name; // in shaders/CMakeLists.txt
    // In the order in which the structure names them.
    std::span<const TriangleRecord> (*triangles)(const StructureSet& set);
    std::vector<StructurePart> parts;
    std::uint64_t bytesPerVisit = 0; // that a step reads, triangles apart
    double (*buildSeconds)(const StructureSet& set) = [](const StructureSet&) { return 0.0; };
    // The driver walks a hierarchy of its own over the boxes of the records: no CPU twin can.
    bool isWalkedByDriver = false;
};

// Builds what it takes. Arrays and triangle records; constants are not counted.
std::uint64_t byteSize(const Structure& structure, const StructureSet& set);

// Throws std::logic_error for a name that is in no declaration.
const Structure& findStructure(std::string_view name);

} // namespace metamarch
