// SPDX-License-Identifier: MIT
#include "metamarch/accel/meta_table.h"

#include "metamarch/accel/cell_box.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <unordered_map>

namespace metamarch {
namespace {

constexpr std::uint32_t kNoLeaf = kMixed - 1u; // marks a mixed brick that has no place yet
constexpr int kSide = kBrickSide;
constexpr std::size_t kWordsPerLoad = 4; // shaders load this many words at once

// Number of bricks that are filled per batch.
constexpr std::size_t kBatch = 1u << 12u;

// Calls visit(first, count) for each row, along x, of the bricks in [lo, hi), which is in bricks too.
template <class Visit>
void visitRows(const CellBox& box, const uvec3 bricks, const Visit& visit) {
    for (int z = box.lo.z; z < box.hi.z; ++z) {
        for (int y = box.lo.y; y < box.hi.y; ++y) {
            if (box.lo.x < box.hi.x) {
                visit(cellIndex(ivec3(box.lo.x, y, z), bricks), box.hi.x - box.lo.x);
            }
        }
    }
}

class TableBuilder {
  public:
    TableBuilder(const uvec3 latticeResolution, const std::span<const Leaf> usedLeaves,
                 const std::uint64_t usedBudget)
        : budget(usedBudget), resolution(latticeResolution), bricks(bricksAlong(latticeResolution)),
          leaves(usedLeaves), words(std::size_t{bricks.x} * bricks.y * bricks.z, kNoLeaf) {}

    std::vector<std::uint32_t> run() {
        nameWholeBricks();
        listLeavesOfMixedBricks();
        placeMixedBricks();
        words.resize((words.size() + (kWordsPerLoad - 1)) / kWordsPerLoad * kWordsPerLoad);
        return std::move(words);
    }

  private:
    // Returns the bricks that share at least one cell with the leaf.
    CellBox touchedBricks(const Leaf& leaf) const {
        const CellBox box = boxOf(leaf);
        return {box.lo / kSide, (box.hi + (kSide - 1)) / kSide};
    }

    // Returns the bricks that lie entirely in the leaf.
    CellBox wholeBricks(const Leaf& leaf) const {
        const CellBox box = boxOf(leaf);
        const auto ends = glm::equal(box.hi, resolution);
        return {(box.lo + (kSide - 1)) / kSide, mix(box.hi / kSide, ivec3(bricks), ends)};
    }

    void nameWholeBricks() {
        tbb::parallel_for(std::size_t{0}, leaves.size(), [&](const std::size_t leafId) {
            visitRows(wholeBricks(leaves[leafId]), bricks, [&](const std::uint32_t first, const int count) {
                std::fill_n(words.begin() + first, count, static_cast<std::uint32_t>(leafId));
            });
        });
    }

    // Calls visit(leafId, brick) for each leaf and each mixed brick that share cells.
    template <class Visit>
    void visitMixed(const Visit& visit) const {
        for (std::uint32_t leafId = 0; leafId < leaves.size(); ++leafId) {
            visitRows(touchedBricks(leaves[leafId]), bricks, [&](const std::uint32_t first, const int count) {
                for (std::uint32_t brick = first; brick < first + static_cast<std::uint32_t>(count);
                     ++brick) {
                    if (words[brick] == kNoLeaf) {
                        visit(leafId, brick);
                    }
                }
            });
        }
    }

    void listLeavesOfMixedBricks() {
        std::vector<std::uint32_t> mixedIds(words.size());
        for (std::uint32_t brick = 0; brick < words.size(); ++brick) {
            if (words[brick] == kNoLeaf) {
                mixedIds[brick] = static_cast<std::uint32_t>(mixed.size());
                mixed.push_back(brick);
            }
        }
        firstLeaf.assign(mixed.size() + 2, 0);
        visitMixed([&](std::uint32_t, const std::uint32_t brick) { ++firstLeaf[mixedIds[brick] + 2]; });
        for (std::size_t i = 2; i < firstLeaf.size(); ++i) {
            firstLeaf[i] += firstLeaf[i - 1];
        }
        leafIds.resize(firstLeaf.back());
        visitMixed([&](const std::uint32_t leafId, const std::uint32_t brick) {
            leafIds[firstLeaf[mixedIds[brick] + 1]++] = leafId;
        });
    }

    struct Brick {
        std::array<std::uint32_t, kBrickCells> leafOfCell;
        std::size_t hash;
    };

    void fill(const std::size_t mixedId, Brick& brick) const {
        const auto at = static_cast<int>(mixed[mixedId]);
        const ivec3 counts(bricks);
        const ivec3 lo = kSide * ivec3(at % counts.x, at / counts.x % counts.y, at / (counts.x * counts.y));
        brick.leafOfCell.fill(0); // cells outside the lattice keep 0
        for (std::size_t i = firstLeaf[mixedId]; i < firstLeaf[mixedId + 1]; ++i) {
            const CellBox leaf = boxOf(leaves[leafIds[i]]);
            const CellBox part{max(leaf.lo - lo, 0), min(leaf.hi - lo, kSide)};
            for (int z = part.lo.z; z < part.hi.z; ++z) {
                for (int y = part.lo.y; y < part.hi.y; ++y) {
                    std::fill_n(brick.leafOfCell.begin() +
                                    cellIndex(ivec3(part.lo.x, y, z), uvec3(kBrickSide)),
                                part.hi.x - part.lo.x, leafIds[i]);
                }
            }
        }
        std::uint64_t hash = 0;
        for (const std::uint32_t leafId : brick.leafOfCell) {
            hash = (hash ^ leafId) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32u;
        }
        brick.hash = hash;
    }

    void placeMixedBricks() {
        std::unordered_multimap<std::size_t, std::uint32_t> places;
        std::vector<Brick> batch(std::min(kBatch, mixed.size()));
        for (std::size_t begin = 0; begin < mixed.size(); begin += kBatch) {
            const std::size_t count = std::min(kBatch, mixed.size() - begin);
            tbb::parallel_for(std::size_t{0}, count, [&](const std::size_t i) { fill(begin + i, batch[i]); });
            for (std::size_t i = 0; i < count; ++i) {
                words[mixed[begin + i]] = kMixed | placeOf(batch[i], places);
            }
        }
    }

    std::uint32_t placeOf(const Brick& brick, std::unordered_multimap<std::size_t, std::uint32_t>& places) {
        const auto [first, last] = places.equal_range(brick.hash);
        for (auto known = first; known != last; ++known) {
            if (std::ranges::equal(brick.leafOfCell, std::span(words).subspan(known->second, kBrickCells))) {
                return known->second;
            }
        }
        if ((words.size() + kBrickCells) * sizeof(std::uint32_t) > budget) {
            throw TableOverBudget(budget);
        }
        const auto place = static_cast<std::uint32_t>(words.size());
        words.insert(words.end(), brick.leafOfCell.begin(), brick.leafOfCell.end());
        places.emplace(brick.hash, place);
        return place;
    }

    std::uint64_t budget; // bytes
    ivec3 resolution;
    uvec3 bricks;
    std::span<const Leaf> leaves;
    std::vector<std::uint32_t> words;
    std::vector<std::uint32_t> mixed;   // indices of the mixed bricks, ascending
    std::vector<std::size_t> firstLeaf; // indexed by place in `mixed`, with one more entry at the end
    std::vector<std::uint32_t> leafIds; // leaves of each mixed brick
};

} // namespace

TableOverBudget::TableOverBudget(const std::uint64_t budget)
    : Error(ErrorKind::outOfMemory,
            fmt::format("the meta table takes more than the {} MiB allowed; choose a "
                        "smaller tree depth or fewer cells",
                        budget >> 20u),
            {"treeDepth", "cells"}) {}

MetaTable buildMetaTable(const uvec3 resolution, const std::span<const Leaf> leaves,
                         const std::uint64_t budget) {
    MetaTable table;
    table.leaves.assign(leaves.begin(), leaves.end());
    table.resolution = resolution;
    table.words = TableBuilder(resolution, leaves, budget).run();
    return table;
}

} // namespace metamarch
