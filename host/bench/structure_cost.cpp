// SPDX-License-Identifier: MIT
#include "metamarch/bench/structure_cost.h"

#include "metamarch/accel/structure.h"
#include "metamarch/shaders/shader_library.h"

namespace metamarch::bench {

std::optional<StructureCost> structureCost(const StructureSet& set, const std::string_view traversal) {
    const std::string_view name = structureOf(traversal);
    if (name.empty()) {
        return std::nullopt;
    }
    const Structure& structure = findStructure(name);
    if (structure.isWalkedByDriver) {
        return std::nullopt;
    }
    return StructureCost{structure.bytesPerVisit, byteSize(structure, set), structure.buildSeconds(set)};
}

double fetchedBytes(const StructureCost& cost, const double visitsPerRay, const double testsPerRay) {
    return visitsPerRay * static_cast<double>(cost.bytesPerVisit) +
           testsPerRay * static_cast<double>(sizeof(TriangleRecord));
}

} // namespace metamarch::bench
