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

// Of the structure that shaders/CMakeLists.txt names for a traversal, or for the floor; builds it where that
// has not been done. Nothing for peers, and where the driver walks a hierarchy of its own.
std::optional<StructureCost> structureCost(const StructureSet& set, std::string_view traversal);

// Of one ray, from what rays do on average.
double fetchedBytes(const StructureCost& cost, double visitsPerRay, double testsPerRay);

} // namespace metamarch::bench
