// SPDX-License-Identifier: MIT
#include "metamarch/accel/leaf_merging.h"

#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/meta_table.h"
#include "metamarch/accel/split.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>

namespace metamarch {
namespace {

struct Part {
    CellBox box;
    std::vector<std::uint32_t> triangleIds; // ascending
};

class Merging {
  public:
    Merging(const Lattice& lattice, const LeafList& list)
        : resolution(lattice.resolution), cellSize(1.0 / glm::dvec3(lattice.cellsPerUnit)),
          table(buildMetaTable(lattice.resolution, list.leaves)), mergedInto(list.leaves.size()) {
        std::iota(mergedInto.begin(), mergedInto.end(), 0u);
        for (const Leaf& leaf : list.leaves) {
            const auto triangleIds = list.trianglesOf(leaf);
            parts.push_back({boxOf(leaf), {triangleIds.begin(), triangleIds.end()}});
        }
    }

    // Joins leaf by leaf and axis by axis until a whole round joins nothing. The loop ends because each join
    // removes one part.
    LeafList run() {
        for (bool joined = true; joined;) {
            joined = false;
            for (std::uint32_t partId = 0; partId < parts.size(); ++partId) {
                for (int axis = 0; axis < 3; ++axis) {
                    while (mergedInto[partId] == partId && joinAbove(partId, axis)) {
                        joined = true;
                    }
                }
            }
        }
        return collect();
    }

  private:
    // Joins the part with the part above it if that is no more expensive.
    bool joinAbove(const std::uint32_t partId, const int axis) {
        Part& part = parts[partId];
        if (part.box.hi[axis] == resolution[axis]) {
            return false;
        }
        ivec3 cell = part.box.lo;
        cell[axis] = part.box.hi[axis];
        const std::uint32_t aboveId = owner(table.leafAt(cell));
        Part& above = parts[aboveId];
        CellBox whole = part.box;
        whole.hi[axis] = above.box.hi[axis];
        ivec3 aboveLo = above.box.lo;
        aboveLo[axis] = part.box.lo[axis];
        if (aboveLo != whole.lo || above.box.hi != whole.hi) {
            return false;
        }
        std::vector<std::uint32_t> triangleIds;
        std::ranges::set_union(part.triangleIds, above.triangleIds, std::back_inserter(triangleIds));
        if (cost(whole, triangleIds.size()) >
            cost(part.box, part.triangleIds.size()) + cost(above.box, above.triangleIds.size())) {
            return false;
        }
        part = {whole, std::move(triangleIds)};
        above.triangleIds.clear();
        mergedInto[aboveId] = partId;
        return true;
    }

    // Expected cost of the part, in triangle tests, up to a factor that is the same for all parts.
    double cost(const CellBox& box, const std::size_t references) const {
        return halfArea(glm::dvec3(box.hi - box.lo) * cellSize) * leafCost(references);
    }

    std::uint32_t owner(std::uint32_t partId) {
        while (mergedInto[partId] != partId) {
            mergedInto[partId] = mergedInto[mergedInto[partId]];
            partId = mergedInto[partId];
        }
        return partId;
    }

    LeafList collect() const {
        LeafList list;
        for (std::uint32_t partId = 0; partId < parts.size(); ++partId) {
            if (mergedInto[partId] == partId) {
                const Part& part = parts[partId];
                list.leaves.push_back({packCell(uvec3(part.box.lo)), packCell(uvec3(part.box.hi)),
                                       static_cast<std::uint32_t>(list.leafTriangles.size()),
                                       static_cast<std::uint32_t>(part.triangleIds.size())});
                list.leafTriangles.insert(list.leafTriangles.end(), part.triangleIds.begin(),
                                          part.triangleIds.end());
            }
        }
        return list;
    }

    ivec3 resolution;
    glm::dvec3 cellSize;
    std::vector<Part> parts; // indexed by leafId
    MetaTable table;
    std::vector<std::uint32_t> mergedInto; // indexed by leafId; a part that still exists maps to itself
};

} // namespace

LeafList mergeLeaves(const Lattice& lattice, const LeafList& list) { return Merging(lattice, list).run(); }

} // namespace metamarch
