// SPDX-License-Identifier: MIT
// The only declaration of the structures that traversals walk. The device gets its arrays from here, and
// benchmarks get the cost.
#pragma once
#include "metamarch/accel/structure_set.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace metamarch {

// An array that shaders declare with lib/memory.glsl, or a block of constants. Structures may share it.
struct StructurePart {
    const char* name;
    std::uint32_t binding;
    std::uint32_t words; // number of words per entry: 1, 2 or 4; 0: constants in a uniform buffer
    std::span<const std::byte> (*data)(const StructureSet& set);
};

struct Structure {
    std::string_view name; // in shaders/CMakeLists.txt
    // Returns the triangle records in the order in which the structure refers to them.
    std::span<const TriangleRecord> (*triangles)(const StructureSet& set);
    std::vector<StructurePart> parts;
    std::uint64_t bytesPerVisit = 0; // bytes that a step reads, without triangles
    double (*buildSeconds)(const StructureSet& set) = [](const StructureSet&) { return 0.0; };
    // The driver walks its own hierarchy over the boxes of the records, so there is no CPU twin.
    bool isWalkedByDriver = false;
};

// Returns the size of arrays and triangle records, without constants. Builds the structure if it does not
// exist yet.
std::uint64_t byteSize(const Structure& structure, const StructureSet& set);

// Throws std::logic_error for an unknown name.
const Structure& findStructure(std::string_view name);

} // namespace metamarch
