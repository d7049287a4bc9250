// SPDX-License-Identifier: MIT
#include "metamarch/accel/partition.h"

#include "metamarch/accel/lattice.h"
#include "metamarch/accel/meta_table.h"
#include "metamarch/error/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace metamarch {
namespace {

constexpr std::uint32_t kNoBox = 0xffffffffu;

[[noreturn]] void refuse(const std::string& line) { throw Error(ErrorKind::inputRefused, line); }

std::string text(const ivec3 cell) { return fmt::format("{} {} {}", cell.x, cell.y, cell.z); }

void checkBox(const CellBox& box, const std::size_t boxId, const ivec3 resolution) {
    if (!glm::all(glm::lessThan(box.lo, box.hi))) {
        refuse(fmt::format("box {}, from {} to {}, holds no cell", boxId, text(box.lo), text(box.hi)));
    }
    if (!glm::all(glm::greaterThanEqual(box.lo, ivec3(0))) ||
        !glm::all(glm::lessThanEqual(box.hi, resolution))) {
        refuse(fmt::format("box {}, from {} to {}, leaves the lattice of {} cells", boxId, text(box.lo),
                           text(box.hi), text(resolution)));
    }
}

// Returns the ids, ascending, of the leaves that hold a cell of `rows`.
std::vector<std::uint32_t> leavesAt(const std::vector<RowOfCells>& rows, const MetaTable& table) {
    std::vector<std::uint32_t> leafIds;
    for (const RowOfCells& row : rows) {
        for (int x = row.x; x < row.endX;) {
            const std::uint32_t leafId = table.leafAt(ivec3(x, row.y, row.z));
            leafIds.push_back(leafId);
            x = boxOf(table.leaves[leafId]).hi.x;
        }
    }
    std::ranges::sort(leafIds);
    const auto repeated = std::ranges::unique(leafIds);
    leafIds.erase(repeated.begin(), repeated.end());
    return leafIds;
}

} // namespace

// Writes each cell at most once before it refuses, so a hostile list cannot keep it busy.
void checkTiling(const Partition& partition) {
    const uvec3 resolution = partition.resolution;
    std::vector<std::uint32_t> boxOfCell(std::size_t{resolution.x} * resolution.y * resolution.z, kNoBox);
    for (std::size_t boxId = 0; boxId < partition.boxes.size(); ++boxId) {
        const CellBox& box = partition.boxes[boxId];
        checkBox(box, boxId, ivec3(resolution));
        for (ivec3 cell = box.lo; cell.z < box.hi.z; ++cell.z) {
            for (cell.y = box.lo.y; cell.y < box.hi.y; ++cell.y) {
                for (cell.x = box.lo.x; cell.x < box.hi.x; ++cell.x) {
                    std::uint32_t& owner = boxOfCell[cellIndex(cell, resolution)];
                    if (owner != kNoBox) {
                        refuse(fmt::format("box {} overlaps box {} at cell {}", boxId, owner, text(cell)));
                    }
                    owner = static_cast<std::uint32_t>(boxId);
                }
            }
        }
    }
    const auto gap = std::ranges::find(boxOfCell, kNoBox);
    if (gap != boxOfCell.end()) {
        const auto index = static_cast<std::uint32_t>(gap - boxOfCell.begin());
        const uvec3 cell(index % resolution.x, index / resolution.x % resolution.y,
                         index / (resolution.x * resolution.y));
        refuse(fmt::format("no box holds cell {}", text(ivec3(cell))));
    }
}

LeafList listTriangles(const Lattice& lattice, const std::span<const CellBox> boxes,
                       const std::span<const LatticeTriangle> corners,
                       const std::span<const std::uint32_t> triangleIds) {
    LeafList list;
    for (const CellBox& box : boxes) {
        list.leaves.push_back({packCell(uvec3(box.lo)), packCell(uvec3(box.hi)), 0, 0});
    }
    const MetaTable table = buildMetaTable(lattice.resolution, list.leaves);
    const glm::dvec3 margin = referenceMargin(lattice);
    std::vector<std::vector<std::uint32_t>> leavesOf(corners.size());
    tbb::parallel_for(std::size_t{0}, corners.size(), [&](const std::size_t i) {
        leavesOf[i] = leavesAt(touchedRows(corners[i], lattice.resolution, margin), table);
    });

    for (const auto& leafIds : leavesOf) {
        for (const std::uint32_t leafId : leafIds) {
            ++list.leaves[leafId].triangleCount;
        }
    }
    std::size_t references = 0;
    for (Leaf& leaf : list.leaves) {
        leaf.firstTriangle = static_cast<std::uint32_t>(references);
        references += leaf.triangleCount;
        leaf.triangleCount = 0;
        if (references >= (std::size_t{1} << 30u)) {
            throw Error(ErrorKind::outOfMemory, "the partition has more than 2^30 references");
        }
    }
    list.leafTriangles.resize(references);
    for (std::size_t i = 0; i < leavesOf.size(); ++i) {
        for (const std::uint32_t leafId : leavesOf[i]) {
            Leaf& leaf = list.leaves[leafId];
            list.leafTriangles[leaf.firstTriangle + leaf.triangleCount++] = triangleIds[i];
        }
    }
    return list;
}

void checkListing(const Lattice& lattice, const LeafList& list,
                  const std::span<const LatticeTriangle> corners,
                  const std::span<const std::uint32_t> triangleIds) {
    std::vector<CellBox> boxes;
    boxes.reserve(list.leaves.size());
    for (const Leaf& leaf : list.leaves) {
        boxes.push_back(boxOf(leaf));
    }
    const LeafList complete = listTriangles(lattice, boxes, corners, triangleIds);
    for (std::size_t leafId = 0; leafId < boxes.size(); ++leafId) {
        const auto listed = list.trianglesOf(list.leaves[leafId]);
        for (const std::uint32_t triangleId : complete.trianglesOf(complete.leaves[leafId])) {
            if (!std::ranges::binary_search(listed, triangleId)) {
                refuse(fmt::format("box {} does not list triangle {}, which touches it", leafId, triangleId));
            }
        }
    }
}

} // namespace metamarch
