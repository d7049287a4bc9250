// SPDX-License-Identifier: MIT
#include "metamarch/accel/reference_boxes.h"

#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/lattice.h"
#include "metamarch/accel/triangle_box.h"
#include "metamarch/accel/triangle_clip.h"
#include "metamarch/shared/reference_box.h"

#include <tbb/parallel_for.h>

#include <cstring>

namespace metamarch {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::size_t kEntryWords = 4;
static_assert(sizeof(Leaf) == kEntryWords * sizeof(std::uint32_t) && sizeof(LeafFrame) == sizeof(Leaf));
static_assert(kBoxesPerGroup == kEntryWords);

class BoxBuilder {
  public:
    BoxBuilder(const Lattice& usedLattice, const std::span<const Leaf> usedLeaves,
               const std::span<const TriangleRecord> usedTriangles)
        : lattice(usedLattice), margin(referenceMargin(usedLattice)), leaves(usedLeaves),
          triangles(usedTriangles) {}

    Words run() {
        std::size_t end = leafEntry(static_cast<std::uint32_t>(leaves.size()));
        std::vector<std::size_t> firstGroups(leaves.size());
        for (std::size_t leafId = 0; leafId < leaves.size(); ++leafId) {
            firstGroups[leafId] = end;
            end += (leaves[leafId].triangleCount + (kBoxesPerGroup - 1)) / kBoxesPerGroup;
        }
        words.assign(end * kEntryWords, kNoBox);
        tbb::parallel_for(std::size_t{0}, leaves.size(),
                          [&](const std::size_t leafId) { fill(leafId, firstGroups[leafId]); });
        return std::move(words);
    }

  private:
    // Returns the box of the part of the triangle in the leaf's exit box, with the margin, in steps of a
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
        return {glm::clamp(part->lo - margin, glm::dvec3(0.0), end) * double{kFrameStepsPerCell},
                glm::clamp(part->hi + margin, glm::dvec3(0.0), end) * double{kFrameStepsPerCell}};
    }

    void fill(const std::size_t leafId, const std::size_t firstGroup) {
        const auto id = static_cast<std::uint32_t>(leafId);
        const Leaf& leaf = leaves[leafId];
        std::vector<Box> boxes(leaf.triangleCount);
        Box all;
        for (std::uint32_t i = 0; i < leaf.triangleCount; ++i) {
            boxes[i] = boxInSteps(leaf, triangles[leaf.firstTriangle + i]);
            all.grow(boxes[i]);
        }
        const bool isEmpty = all.lo.x > all.hi.x;
        const glm::dvec3 first = isEmpty ? glm::dvec3(0.0) : glm::floor(all.lo);
        const glm::dvec3 length = isEmpty ? glm::dvec3(1.0) : glm::max(glm::ceil(all.hi) - first, 1.0);
        const uvec3 begin(first);
        const uvec3 size(length);
        const LeafFrame frame{packFrameAxis(begin.x, size.x), packFrameAxis(begin.y, size.y),
                              packFrameAxis(begin.z, size.z), static_cast<std::uint32_t>(firstGroup)};
        std::memcpy(entry(leafEntry(id)), &leaf, sizeof leaf);
        std::memcpy(entry(frameEntry(id)), &frame, sizeof frame);
        const glm::dvec3 partsPerStep = double{kBoxParts} / length;
        for (std::uint32_t i = 0; i < leaf.triangleCount; ++i) {
            if (boxes[i].lo.x <= boxes[i].hi.x) {
                entry(firstGroup)[i] =
                    packReferenceBox(toParts(glm::floor((boxes[i].lo - first) * partsPerStep)),
                                     toParts(glm::ceil((boxes[i].hi - first) * partsPerStep)));
            }
        }
    }

    std::uint32_t* entry(const std::size_t i) { return &words[i * kEntryWords]; }

    static uvec3 toParts(const glm::dvec3& parts) { return uvec3(glm::clamp(parts, 0.0, double{kBoxParts})); }

    const Lattice& lattice;
    glm::dvec3 margin; // in cells
    std::span<const Leaf> leaves;
    std::span<const TriangleRecord> triangles;
    Words words;
};

} // namespace

std::vector<std::uint32_t> frameLeaves(const Lattice& lattice, const std::span<const Leaf> leaves,
                                       const std::span<const TriangleRecord> triangles) {
    return BoxBuilder(lattice, leaves, triangles).run();
}

} // namespace metamarch
