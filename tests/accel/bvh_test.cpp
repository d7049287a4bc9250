// SPDX-License-Identifier: MIT
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/bvh.h"
#include "metamarch/accel/lattice.h"
#include "metamarch/accel/triangle_box.h"

#include <gtest/gtest.h>

namespace metamarch::tests {
namespace {

std::uint32_t trianglesBelow(const Bvh& bvh, const std::uint32_t child) {
    if (isBvhLeaf(child)) {
        return bvhTriangleCount(child);
    }
    return trianglesBelow(bvh, bvh.nodes[child].child0) + trianglesBelow(bvh, bvh.nodes[child].child1);
}

// Two groups of triangles, far apart. The surface area heuristic counts what both children cost: it cuts
// between the groups. The cheapest child alone would be a single triangle.
TEST(Bvh, splitsWhereBothChildrenAreCheap) {
    Scene scene;
    for (int i = 0; i < 40; ++i) {
        const float x = static_cast<float>(i % 8) + (i < 24 ? 0.0f : 100.0f);
        const float y = static_cast<float>(i % 5);
        addTriangle(scene, {x, y, 0}, {x + 1, y, 0}, {x, y + 1, 1});
    }
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const Bvh bvh = buildBvh(structure.lattice, makeTriangleRecords(scene, nonDegenerateTriangles(scene)));
    EXPECT_EQ(trianglesBelow(bvh, bvh.nodes[0].child0), 24u);
    EXPECT_EQ(trianglesBelow(bvh, bvh.nodes[0].child1), 16u);
}

// src/accel/README.md sums up to 87 half-ulps of the longest side, on a device that truncates and divides
// roughly.
TEST(Bvh, boxesHaveRoomForEveryError) {
    Scene scene;
    addTriangle(scene, {1, 2, 3}, {7, 3, 4}, {2, 5, 3.5f});
    addTriangle(scene, {90, 1, 1}, {91, 2, 1}, {90, 3, 2});
    const Lattice lattice = buildAccelerationStructure(scene, {}).lattice;
    const glm::dvec3 longestSide = referenceMargin(lattice) / kReferenceMargin;
    const glm::dvec3 room = 87.0 * 0x1p-24 * longestSide;
    for (const TriangleRecord& triangle : makeTriangleRecords(scene, nonDegenerateTriangles(scene))) {
        const Box box = boxOf(lattice, triangle);
        for (const vec3 vertex : {triangle.v0, triangle.v1, triangle.v2}) {
            const glm::dvec3 at = toLattice(lattice, vertex);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(box.lo[axis], at[axis] - room[axis]);
                EXPECT_GE(box.hi[axis], at[axis] + room[axis]);
            }
        }
    }
}

} // namespace
} // namespace metamarch::tests
