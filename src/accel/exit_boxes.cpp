// SPDX-License-Identifier: MIT
#include "metamarch/accel/exit_boxes.h"

#include "metamarch/accel/cell_box.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace metamarch {
namespace {

// Limit of table look-ups while the box of one leaf grows; when it is reached, the box stays as it is.
// Measured on scenes of 70,000 to 200,000 triangles: in steps per ray, 256 are almost enough and 1024 are
// enough.
constexpr unsigned kMostLooks = 1024;

constexpr unsigned kFaces = 6;

class Growth {
  public:
    Growth(const LeafList& usedList, const MetaTable& usedTable)
        : resolution(usedTable.resolution), list(usedList), table(usedTable) {}

    // Moves the faces outwards in turn, each as far as the leaves behind it allow. A face that cannot move is
    // never tried again: a larger box has even more leaves behind that face.
    CellBox grow(const Leaf& leaf) const {
        CellBox box = boxOf(leaf);
        unsigned looks = 0;
        std::array<bool, kFaces> held{};
        while (!std::ranges::all_of(held, std::identity())) {
            for (unsigned face = 0; face < kFaces; ++face) {
                const int axis = static_cast<int>(face / 2);
                const bool above = face % 2 == 1;
                const int layers = held[face] ? 0 : freeLayers(leaf, box, axis, above, looks);
                held[face] = layers == 0;
                (above ? box.hi : box.lo)[axis] += above ? layers : -layers;
            }
        }
        return box;
    }

  private:
    // Returns the number of cell layers behind a face of the box whose leaves list only triangles of `leaf`.
    int freeLayers(const Leaf& leaf, const CellBox& box, const int axis, const bool above,
                   unsigned& looks) const {
        const int first = above ? box.hi[axis] : box.lo[axis] - 1;
        if (first < 0 || first >= resolution[axis]) {
            return 0;
        }
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        int layers = resolution[axis];
        ivec3 cell;
        cell[axis] = first;
        // Each leaf behind the face is skipped in one go, and so are the rows in which no new leaf begins.
        for (cell[v] = box.lo[v]; cell[v] < box.hi[v];) {
            int nextRow = box.hi[v];
            for (cell[u] = box.lo[u]; cell[u] < box.hi[u];) {
                const Leaf& behind = list.leaves[table.leafAt(cell)];
                if (++looks > kMostLooks || !holdsAllOf(leaf, behind)) {
                    return 0;
                }
                const auto [lo, hi] = boxOf(behind);
                layers = std::min(layers, above ? hi[axis] - first : first + 1 - lo[axis]);
                nextRow = std::min(nextRow, hi[v]);
                cell[u] = hi[u];
            }
            cell[v] = nextRow;
        }
        return layers;
    }

    bool holdsAllOf(const Leaf& leaf, const Leaf& other) const {
        return other.triangleCount <= leaf.triangleCount &&
               std::ranges::includes(list.trianglesOf(leaf), list.trianglesOf(other));
    }

    ivec3 resolution;
    const LeafList& list;
    const MetaTable& table;
};

} // namespace

void growExitBoxes(const LeafList& list, MetaTable& table) {
    const Growth growth(list, table);
    tbb::parallel_for(std::size_t{0}, list.leaves.size(), [&](const std::size_t leafId) {
        const CellBox box = growth.grow(list.leaves[leafId]);
        table.leaves[leafId].lo = packCell(uvec3(box.lo));
        table.leaves[leafId].hi = packCell(uvec3(box.hi));
    });
}

} // namespace metamarch
