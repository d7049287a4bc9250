// SPDX-License-Identifier: MIT
// What a traversal's structure takes: bytes fetched, bytes kept, time to build.
#pragma once
#include "metamarch/accel/structure_set.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace metamarch::bench {

// Bytes that a visit reads; a triangle test reads a record. Caches are left out: it is what the traversal
// asks for. Rays count inner nodes and leaves together, so all visits of a tree cost the same here: what an
// inner node costs. The 16 bytes of a kd-tree's leaf are left out thereby, and a BVH's leaf, which has no
// record, counts 64.
struct StructureCost {
    std::uint64_t bytesPerVisit;
    std::uint64_t bytes;
    double buildSeconds;
};

// Returns the cost of the structure that shaders/CMakeLists.txt names for the traversal, or for the floor.
// Builds the structure if nobody has asked for it yet. Returns nothing for peers, and where the driver walks
// a hierarchy of its own.
std::optional<StructureCost> structureCost(const StructureSet& set, std::string_view traversal);

// Bytes that one ray reads, from the means of visits and tests per ray.
double fetchedBytes(const StructureCost& cost, double visitsPerRay, double testsPerRay);

} // namespace metamarch::bench
