#include "accel/meta_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace metamarch {

std::vector<std::uint32_t> buildMetaTable(const Lattice& lattice, const std::span<const Leaf> leaves) {
    std::vector<std::uint32_t> leafOfCell(lattice.cellCount);
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](const std::size_t leafId) {
        const ivec3 lo = unpackCell(leaves[leafId].lo);
        const ivec3 hi = unpackCell(leaves[leafId].hi);
        for (int z = lo.z; z < hi.z; ++z) {
            for (int y = lo.y; y < hi.y; ++y) {
                std::fill_n(leafOfCell.begin() + cellIndex(ivec3(lo.x, y, z), lattice.resolution),
                            hi.x - lo.x, static_cast<std::uint32_t>(leafId));
            }
        }
    });
    return leafOfCell;
}

} // namespace metamarch
