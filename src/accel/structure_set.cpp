// SPDX-License-Identifier: MIT
#include "metamarch/accel/structure_set.h"

#include <algorithm>

namespace metamarch {

// Every non-degenerate triangle lies in some leaf.
StructureSet::Triangles StructureSet::uniqueTriangles(Triangles records) {
    std::ranges::sort(records, {}, &TriangleRecord::triangleId);
    const auto repeated = std::ranges::unique(records, {}, &TriangleRecord::triangleId);
    records.erase(repeated.begin(), repeated.end());
    return records;
}

StructureSet::Triangles StructureSet::firstOccurrences(const Triangles& records) {
    Triangles first;
    std::vector<bool> seen; // [triangleId]
    for (const TriangleRecord& record : records) {
        if (record.triangleId >= seen.size()) {
            seen.resize(std::size_t{record.triangleId} + 1);
        }
        if (!seen[record.triangleId]) {
            seen[record.triangleId] = true;
            first.push_back(record);
        }
    }
    return first;
}

RectilinearTable StructureSet::makeRectilinearTable(const Triangles& records) const {
    const AccelerationOptions& options = structure.options;
    const bool isWanted = options.table == TableMethod::rectilinear && options.treeDepth;
    const unsigned limit = options.treeDepth.value_or(defaultTreeDepth(structure.lattice.triangleCount));
    return buildRectilinearTable(structure.lattice, records, {limit, isWanted}, options.exitBoxes);
}

} // namespace metamarch
