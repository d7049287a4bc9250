// SPDX-License-Identifier: MIT
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/bvh.h"

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

} // namespace
} // namespace metamarch::tests
