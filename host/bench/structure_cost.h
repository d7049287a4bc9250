// What a traversal's structure takes: bytes fetched, bytes kept, time to build.
#pragma once
#include "metamarch/accel/structure_set.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
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

class StructureCosts {
  public:
    explicit StructureCosts(const StructureSet& structureSet) : set(structureSet) {}

    // Builds the structure on the first call. Nothing for traversals whose structure is not known here.
    std::optional<StructureCost> of(std::string_view traversal);

  private:
    std::optional<StructureCost> measure(std::string_view traversal) const;

    const StructureSet& set;
    std::map<std::string, std::optional<StructureCost>, std::less<>> known;
};

// Of one ray, from what rays do on average.
double fetchedBytes(const StructureCost& cost, double visitsPerRay, double testsPerRay);

} // namespace metamarch::bench
