// SPDX-License-Identifier: MIT
// A ray that misses a reference's box does not test the triangle, so every box must contain all that a ray
// can hit of it within the leaf's exit box.
#include "accel/pinwheel.h"
#include "fixtures/named_scene.h"
#include "fixtures/ray_sets.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/reference_boxes.h"
#include "metamarch/shared/march.h"
#include "metamarch/shared/reference_box.h"
#include "metamarch/shared/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace metamarch::tests {
namespace {

Scene soup() { return triangleSoup(600, 1); }

// Coordinates so large that a float step is a thousandth of the scene.
Scene farSoup() {
    Scene scene = triangleSoup(400, 5);
    for (glm::vec3& position : scene.positions) {
        position += glm::vec3(8192.0f, -8192.0f, 8192.0f);
    }
    return scene;
}

// Long triangles, a thousandth as wide as long, in all directions.
Scene slivers() {
    Scene scene;
    for (int i = 0; i < 200; ++i) {
        const auto angle = static_cast<float>(i);
        const glm::vec3 along(std::cos(angle), std::sin(angle), std::cos(3.0f * angle));
        const glm::vec3 across = 1e-3f * glm::vec3(along.z, along.x, along.y);
        addTriangle(scene, -along, along, along + across);
    }
    return scene;
}

// A plane of no height: its lattice is four margins high.
Scene flat() {
    Scene scene;
    addPlane(scene, 0.0f, 1.0f);
    return scene;
}

// Leaves that no kd-tree can make.
AccelerationOptions pinwheels() {
    AccelerationOptions options;
    options.partition = nestedPinwheels({40, 36, 44}, 64, 3);
    return options;
}

const NamedScene kScenes[] = {
    {"one_triangle", oneTriangle},
    {"unit_cube_integer_planes", unitCube, {glm::dvec3(0.125), {}, {}}},
    {"soup", soup},
    {"soup_anisotropic", soup, {glm::dvec3(0.01, 0.3, 0.05), {}, {}}},
    {"soup_own_exits", soup, {{}, {}, {}, TableMethod::unit, {}, false}},
    {"soup_in_one_leaf", soup, {{}, {}, 0}},
    {"soup_merged", soup, {{}, {}, {}, TableMethod::unit, {}, true, true}},
    {"soup_gcd", soup, {{}, {}, {}, TableMethod::gcd}},
    {"soup_in_pinwheels", soup, pinwheels()},
    {"far_soup", farSoup},
    {"slivers", slivers},
    {"flat", flat, {glm::dvec3(0.01, 1e-6, 0.01), {}, {}}},
    {"sphere_in_stadium", [] { return sphereOnFloor(24, 12, 5000.0f); }},
};

class ReferenceBoxes : public testing::TestWithParam<NamedScene> {
  protected:
    const Scene scene = GetParam().make();
    const AccelerationStructure structure = buildAccelerationStructure(scene, GetParam().options);
    const MetaTable& table = structure.table;

    LeafHead headOf(const std::uint32_t record) const {
        const std::uint32_t* const words = wordsOf(record);
        return {words[0], words[1], words[2], words[3]};
    }

    LeafFrame frameOf(const std::uint32_t record) const {
        const std::uint32_t* const words = wordsOf(frameEntry(record));
        return {words[0], words[1], words[2], words[3]};
    }

    std::uint32_t box(const std::uint32_t record, const std::uint32_t reference) const {
        return wordsOf(firstBoxes(record))[reference];
    }

    const TriangleRecord& triangle(const std::uint32_t record, const std::uint32_t reference) const {
        return table.triangles.at(wordsOf(frameOf(record).firstIndices)[reference]);
    }

    float test(const Ray& ray, const TriangleRecord& triangle) const {
        return intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2);
    }

  private:
    const std::uint32_t* wordsOf(const std::uint32_t entry) const {
        return &table.leafRecords.at(4 * std::size_t{entry});
    }
};

// The words behind a leaf's last box are never met, so the march needs no count. Each record begins where the
// one before it ends.
TEST_P(ReferenceBoxes, lieInTheRecordOfTheirLeaf) {
    std::uint32_t record = 0;
    for (std::uint32_t leafId = 0; leafId < table.leaves.size(); ++leafId) {
        const Leaf& leaf = table.leaves[leafId];
        const LeafHead head = headOf(record);
        ASSERT_EQ(head.lo, leaf.lo);
        ASSERT_EQ(head.hi, leaf.hi);
        ASSERT_EQ(head.leafId, leafId);
        ASSERT_EQ(head.triangleCount, leaf.triangleCount);
        if (leaf.triangleCount == 0) {
            ++record;
            continue;
        }
        const std::uint32_t groups = (leaf.triangleCount + kBoxesPerGroup - 1) / kBoxesPerGroup;
        for (std::uint32_t i = leaf.triangleCount; i < groups * kBoxesPerGroup; ++i) {
            ASSERT_EQ(box(record, i), kNoBox);
        }
        ASSERT_EQ(frameOf(record).firstIndices, firstBoxes(record) + groups);
        record = frameOf(record).firstIndices + groups;
    }
    EXPECT_EQ(table.leafRecords.size(), 4 * std::size_t{record});
}

// A cell's record is that of its leaf, and has the leaf's triangles in their order.
TEST_P(ReferenceBoxes, areFoundByTheCellsOfTheirLeaf) {
    const uvec3 resolution = structure.lattice.resolution;
    // Without merging and partition the table has the leaves of the tree.
    const bool hasTreesLeaves = !GetParam().options.mergeLeaves && !GetParam().options.partition;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const ivec3 cell(uvec3(i * 7919u, i * 104729u, i * 1299709u) % resolution);
        const std::uint32_t record = table.recordAt(cell);
        const std::uint32_t leafId = table.leafAt(cell);
        ASSERT_EQ(headOf(record).leafId, leafId);
        const Leaf& leaf = table.leaves[leafId];
        for (std::uint32_t k = 0; hasTreesLeaves && k < leaf.triangleCount; ++k) {
            ASSERT_EQ(triangle(record, k).triangleId, structure.tree.leafTriangles[leaf.firstTriangle + k]);
        }
    }
}

TEST_P(ReferenceBoxes, shareARecordForEachTriangle) {
    std::vector<std::uint32_t> ids;
    for (const TriangleRecord& triangle : table.triangles) {
        ids.push_back(triangle.triangleId);
        ASSERT_EQ(triangle.v0, scene.positions[scene.triangles[triangle.triangleId].x]);
    }
    std::ranges::sort(ids);
    EXPECT_EQ(ids, nonDegenerateTriangles(scene));
}

// The march with every test. A hit belongs to the first leaf that the ray leaves behind it; there the ray
// must meet the box. (Where a ray runs in a plane between cells, t may fall from one leaf to the next.)
TEST_P(ReferenceBoxes, areMetByEveryRayThatHitsTheTriangleInTheLeaf) {
    const uvec3 resolution = structure.lattice.resolution;
    std::uint64_t hits = 0;
    std::uint64_t met = 0;
    std::uint64_t references = 0;
    for (const RayQuery& query : trickyRays(scene, structure, 4000, 3)) {
        const Ray ray = makeRay(structure.lattice, query.origin, query.tMin, query.dir, query.tMax);
        if (ray.tMax < ray.tMin) {
            continue;
        }
        BoxExit next{ray.tNear, cellAt(ray, ray.tNear, ivec3(0), ivec3(resolution))};
        float reached = ray.tNear;
        while (isInLattice(next.cell, resolution)) {
            const std::uint32_t record = table.recordAt(next.cell);
            const LeafHead leaf = headOf(record);
            const float tNear = next.t;
            next = leaveBox(ray, unpackCell(leaf.lo), unpackCell(leaf.hi), next.cell);
            const FrameCrossing frame =
                leaf.triangleCount == 0 ? FrameCrossing{} : crossFrame(ray, frameOf(record));
            const uvec3 shift = nearPlaneShift(ray);
            for (std::uint32_t i = 0; i < leaf.triangleCount; ++i) {
                const float t = test(ray, triangle(record, i));
                const bool isHit = t != kNoHit && t >= reached && t <= next.t && t <= ray.tMax;
                // The narrowest span that holds the hit asks most of the box.
                const vec2 span = isHit ? vec2(t, t) : vec2(tNear, next.t);
                const vec2 inFrame = crossReferenceBox(frame, shift, kWholeFrame, span);
                const vec2 inBox = crossReferenceBox(frame, shift, box(record, i), inFrame);
                ASSERT_TRUE(!isHit || inBox.x <= inBox.y)
                    << describe(query) << ": triangle " << i << " of leaf " << leaf.leafId << " at " << t;
                hits += isHit ? 1u : 0u;
                met += inBox.x <= inBox.y ? 1u : 0u;
                ++references;
            }
            reached = larger(reached, next.t);
        }
    }
    if (references > 0) {
        EXPECT_GT(hits, 0u);
    }
    if (table.leaves.size() > 100) {
        EXPECT_LT(10 * met, 7 * references);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReferenceBoxes, testing::ValuesIn(kScenes),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(ReferenceBox, isNotMadeWithoutTriangles) {
    const MetaTable table = buildAccelerationStructure(noTriangles(), {}).table;
    EXPECT_EQ(table.leafRecords.size(), 4 * table.leaves.size()); // heads
}

TEST(ReferenceBox, thatFillsAGroupIsMetByNoRay) {
    const AccelerationStructure structure = buildAccelerationStructure(unitCube(), {});
    const std::uint32_t thinAndFar = packFrameAxis(1022 * kFrameStepsPerCell, 1);
    const std::uint32_t whole = packFrameAxis(0, kMaxLatticeResolution * kFrameStepsPerCell);
    for (const RayQuery& query : trickyRays(unitCube(), structure, 1000, 7)) {
        const Ray ray = makeRay(structure.lattice, query.origin, query.tMin, query.dir, query.tMax);
        for (const LeafFrame& frame :
             {LeafFrame{thinAndFar, thinAndFar, thinAndFar, 0}, LeafFrame{whole, whole, whole, 0}}) {
            const vec2 inBox = crossReferenceBox(crossFrame(ray, frame), nearPlaneShift(ray), kNoBox,
                                                 {-kFarthest, kFarthest});
            ASSERT_GT(inBox.x, inBox.y) << describe(query);
        }
    }
}

// The frame begins just before cell 1, and is 1.5 cells long on x and y: 96 steps of a cell's 64th, and two
// for the margin. On z it has no length but the margin.
TEST(ReferenceBox, isRoundedOutwardsToParts) {
    Lattice lattice{};
    lattice.extent = 4.0f;
    lattice.cellsPerUnit = glm::vec3(1.0f);
    lattice.resolution = glm::uvec3(4);
    MetaTable table;
    table.resolution = lattice.resolution;
    table.leaves = {{packCell({0, 0, 0}), packCell({4, 4, 4}), 0, 2}};
    table.words = {0, 0, 0, 0};
    table.triangles = {{{1, 1, 1}, 0, {1.25f, 1, 1}, 0, {1, 1.5f, 1}, 0},
                       {{1, 1, 1}, 1, {2.5f, 1, 1}, 0, {1, 2.5f, 1}, 0}};
    const std::uint32_t indices[] = {1, 0};
    recordLeaves(lattice, indices, table);
    const std::vector<std::uint32_t>& words = table.leafRecords;
    ASSERT_EQ(words.size(), 16u);
    EXPECT_EQ(words[4], packFrameAxis(63, 98));
    EXPECT_EQ(words[5], packFrameAxis(63, 98));
    EXPECT_EQ(words[6], packFrameAxis(63, 2));
    EXPECT_EQ(words[7], 3u);
    // 1 to 2.5 cells are steps 1 to 97 of 98: parts 0.3 to 30.7. 1.25 cells are step 17: part 5.4, and 1.5
    // are step 33: part 10.4.
    EXPECT_EQ(words[8], packReferenceBox({0, 0, 15}, {31, 31, 16}));
    EXPECT_EQ(words[9], packReferenceBox({0, 0, 15}, {6, 11, 16}));
    EXPECT_EQ(words[10], kNoBox);
    EXPECT_EQ(words[11], kNoBox);
    EXPECT_EQ(words[12], 1u);
    EXPECT_EQ(words[13], 0u);
}

} // namespace
} // namespace metamarch::tests
