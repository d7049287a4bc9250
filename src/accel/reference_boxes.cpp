// SPDX-License-Identifier: MIT
#include "metamarch/accel/reference_boxes.h"

#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/lattice.h"
#include "metamarch/accel/triangle_box.h"
#include "metamarch/accel/triangle_clip.h"
#include "metamarch/error/error.h"
#include "metamarch/shared/reference_box.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

namespace metamarch {
namespace {

constexpr std::size_t kEntryWords = 4;
static_assert(sizeof(LeafHead) == kEntryWords * sizeof(std::uint32_t) &&
              sizeof(LeafFrame) == sizeof(LeafHead));
static_assert(kBoxesPerGroup == kEntryWords);

class RecordBuilder {
  public:
    RecordBuilder(const Lattice& usedLattice, const std::span<const std::uint32_t> usedIndices,
                  MetaTable& filledTable)
        : lattice(usedLattice), margin(referenceMargin(usedLattice)),
          boxMargin(kBoxMargin / kReferenceMargin * margin), indices(usedIndices), table(filledTable) {}

    void run() {
        std::vector<std::uint32_t> records(table.leaves.size());
        std::size_t end = 0;
        for (std::size_t leafId = 0; leafId < records.size(); ++leafId) {
            records[leafId] = static_cast<std::uint32_t>(end);
            const std::size_t groups = groupsOf(table.leaves[leafId]);
            end += groups == 0 ? 1 : 2 + 2 * groups;
        }
        if (end > kMixed) { // entries of the table cannot name more
            throw Error(ErrorKind::outOfMemory, "the records of the meta table's leaves exceed 32 GiB");
        }
        table.leafRecords.assign(end * kEntryWords, kNoBox);
        tbb::parallel_for(std::size_t{0}, records.size(),
                          [&](const std::size_t leafId) { fill(leafId, records[leafId]); });
        const auto bricks = bricksAlong(table.resolution);
        const std::size_t brickCount = std::size_t{bricks.x} * bricks.y * bricks.z;
        table.recordWords.resize(table.words.size());
        tbb::parallel_for(std::size_t{0}, table.words.size(), [&](const std::size_t i) {
            const std::uint32_t word = table.words[i];
            table.recordWords[i] = i < brickCount && isMixed(word) ? word : records[word];
        });
    }

  private:
    // Returns the box of the part of the triangle in the leaf's exit box, with its margin, in steps of a
    // frame. The box is empty if there is no such part. No hit is outside the lattice.
    Box boxInSteps(const Leaf& leaf, const TriangleRecord& triangle) const {
        const CellBox exit = metamarch::boxOf(leaf);
        const std::optional<Box> part =
            clipTriangle({toLattice(lattice, triangle.v0), toLattice(lattice, triangle.v1),
                          toLattice(lattice, triangle.v2)},
                         {glm::dvec3(exit.lo) - margin, glm::dvec3(exit.hi) + margin});
        if (!part) {
            return {};
        }
        const glm::dvec3 end(lattice.resolution);
        return {glm::clamp(part->lo - boxMargin, glm::dvec3(0.0), end) * double{kFrameStepsPerCell},
                glm::clamp(part->hi + boxMargin, glm::dvec3(0.0), end) * double{kFrameStepsPerCell}};
    }

    static std::size_t groupsOf(const Leaf& leaf) {
        return (leaf.triangleCount + std::size_t{kBoxesPerGroup - 1}) / kBoxesPerGroup;
    }

    void fill(const std::size_t leafId, const std::uint32_t record) {
        const Leaf& leaf = table.leaves[leafId];
        const LeafHead head{leaf.lo, leaf.hi, static_cast<std::uint32_t>(leafId), leaf.triangleCount};
        std::memcpy(entry(record), &head, sizeof head);
        if (leaf.triangleCount == 0) {
            return;
        }
        const std::span<const std::uint32_t> ofLeaf = indices.subspan(leaf.firstTriangle, leaf.triangleCount);
        std::vector<Box> boxes(leaf.triangleCount);
        Box all;
        for (std::uint32_t i = 0; i < leaf.triangleCount; ++i) {
            boxes[i] = boxInSteps(leaf, table.triangles[ofLeaf[i]]);
            all.grow(boxes[i]);
        }
        const bool isEmpty = all.lo.x > all.hi.x;
        const glm::dvec3 first = isEmpty ? glm::dvec3(0.0) : glm::floor(all.lo);
        const glm::dvec3 length = isEmpty ? glm::dvec3(1.0) : glm::max(glm::ceil(all.hi) - first, 1.0);
        const uvec3 begin(first);
        const uvec3 size(length);
        const auto firstIndices = static_cast<std::uint32_t>(firstBoxes(record) + groupsOf(leaf));
        const LeafFrame frame{packFrameAxis(begin.x, size.x), packFrameAxis(begin.y, size.y),
                              packFrameAxis(begin.z, size.z), firstIndices};
        std::memcpy(entry(frameEntry(record)), &frame, sizeof frame);
        const glm::dvec3 partsPerStep = double{kBoxParts} / length;
        std::uint32_t* const words = entry(firstBoxes(record));
        for (std::uint32_t i = 0; i < leaf.triangleCount; ++i) {
            if (boxes[i].lo.x <= boxes[i].hi.x) {
                words[i] = packReferenceBox(toParts(glm::floor((boxes[i].lo - first) * partsPerStep)),
                                            toParts(glm::ceil((boxes[i].hi - first) * partsPerStep)));
            }
        }
        // No ray meets the boxes behind the last reference, so their indices are never read.
        std::ranges::copy(ofLeaf, entry(firstIndices));
    }

    std::uint32_t* entry(const std::size_t i) { return &table.leafRecords[i * kEntryWords]; }

    static uvec3 toParts(const glm::dvec3& parts) { return uvec3(glm::clamp(parts, 0.0, double{kBoxParts})); }

    const Lattice& lattice;
    glm::dvec3 margin; // in cells
    glm::dvec3 boxMargin;
    std::span<const std::uint32_t> indices;
    MetaTable& table;
};

} // namespace

SharedTriangles shareTriangles(const std::span<const std::uint32_t> leafTriangles,
                               const std::size_t triangleCount) {
    constexpr std::uint32_t kNoPlace = 0xffffffffu;
    std::vector<std::uint32_t> placeOf(triangleCount, kNoPlace);
    SharedTriangles shared;
    shared.indices.reserve(leafTriangles.size());
    for (const std::uint32_t id : leafTriangles) {
        std::uint32_t& place = placeOf[id];
        if (place == kNoPlace) {
            place = static_cast<std::uint32_t>(shared.ids.size());
            shared.ids.push_back(id);
        }
        shared.indices.push_back(place);
    }
    return shared;
}

void recordLeaves(const Lattice& lattice, const std::span<const std::uint32_t> indices, MetaTable& table) {
    RecordBuilder(lattice, indices, table).run();
}

} // namespace metamarch
