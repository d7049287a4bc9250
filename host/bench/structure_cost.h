// SPDX-License-Identifier: MIT
// The cost of a traversal's structure: bytes fetched, size in bytes, time to build.
#pragma once
#include "metamarch/accel/structure_set.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace metamarch::bench {

// `bytesPerVisit` are the bytes that a traversal requests per visit, before caches. A triangle test requests
// a triangle record more. Rays count inner nodes and leaves together, so every visit of a tree counts like
// that of an inner node: the 16 bytes of a kd-tree's leaf are left out, and a BVH's leaf, which has no
// record, counts 64 bytes. Every leaf of the meta table counts its frame, and none its reference boxes, of
// which four are 16 bytes.
struct StructureCost {
    std::uint64_t bytesPerVisit;
    std::uint64_t bytes;
    double buildSeconds;
};

// Returns the cost of the structure that shaders/CMakeLists.txt names for the traversal, or for the floor.
// Builds the structure if it does not exist yet. Returns nothing for peers, and for a traversal in which the
// driver walks a hierarchy of its own.
std::optional<StructureCost> structureCost(const StructureSet& set, std::string_view traversal);

// Returns the bytes that one ray requests, from the mean numbers of visits and tests per ray.
double fetchedBytes(const StructureCost& cost, double visitsPerRay, double testsPerRay);

} // namespace metamarch::bench
