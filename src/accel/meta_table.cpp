#include "accel/meta_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace metamarch {

MetaTable buildMetaTable(const uvec3 resolution, const std::span<const Leaf> leaves) {
    MetaTable table{{leaves.begin(), leaves.end()},
                    std::vector<std::uint32_t>(std::size_t{resolution.x} * resolution.y * resolution.z),
                    {}};
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](const std::size_t leafId) {
        const ivec3 lo = unpackCell(leaves[leafId].lo);
        const ivec3 hi = unpackCell(leaves[leafId].hi);
        for (int z = lo.z; z < hi.z; ++z) {
            for (int y = lo.y; y < hi.y; ++y) {
                std::fill_n(table.leafOfCell.begin() + cellIndex(ivec3(lo.x, y, z), resolution), hi.x - lo.x,
                            static_cast<std::uint32_t>(leafId));
            }
        }
    });
    return table;
}

} // namespace metamarch
