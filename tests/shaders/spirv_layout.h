// SPDX-License-Identifier: MIT
// Reads what a SPIR-V module declares: the memory layout of its buffers, and which float operations are
// exact.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace metamarch::tests {

struct SpirvMember {
    std::string name;
    std::uint32_t typeId = 0;
    std::optional<std::uint32_t> offset; // bytes; only members of structs in memory have one
};

struct SpirvStruct {
    std::string name;
    bool isBlock = false; // the whole of a buffer or of the push constants
    std::vector<SpirvMember> members;

    bool liesInMemory() const { return !members.empty() && members.front().offset.has_value(); }
};

struct SpirvArray {
    std::uint32_t elementTypeId = 0;
    std::optional<std::uint32_t> stride; // bytes; only arrays in memory have one
};

struct SpirvLayout {
    std::map<std::uint32_t, SpirvStruct> structs;   // [type id]
    std::map<std::uint32_t, SpirvArray> arrays;     // [type id]; of fixed and of runtime length
    std::map<std::uint32_t, std::uint32_t> numbers; // [type id]; sizes in bytes of scalars and vectors
    std::uint32_t storageBuffers = 0;
    std::uint32_t texelBuffers = 0;   // also the hierarchies of ray queries
    std::set<std::uint32_t> exactIds; // results that a driver may neither contract nor reorder
    std::uint32_t exactFloatOperations = 0;
    std::uint32_t looseFloatOperations = 0;
};

// Throws std::runtime_error if the words are not a module.
SpirvLayout readLayout(std::span<const std::uint32_t> spirv);

} // namespace metamarch::tests
