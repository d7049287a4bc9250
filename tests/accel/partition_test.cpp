// SPDX-License-Identifier: MIT
// Boxes that no kd-tree made must tile the lattice and list their triangles; then rays march through them.
#include "accel/overlap.h"
#include "accel/pinwheel.h"
#include "fixtures/expect_error.h"
#include "fixtures/ray_sets.h"
#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/leaf_merging.h"
#include "metamarch/accel/partition_file.h"
#include "metamarch/reference/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace metamarch::tests {
namespace {

// The paper's figure 11, one cell deep.
const Partition kFigure11{{3, 3, 1}, flatPinwheel({{0, 0, 0}, {3, 3, 1}}, 2, {1, 1, 0}, {2, 2, 0})};

const Partition kSolid{{2, 2, 2}, solidPinwheel({ivec3(0), ivec3(2)}, ivec3(1))};

bool everyPlaneCutsABox(const Partition& partition) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int plane = 1; plane < static_cast<int>(partition.resolution[axis]); ++plane) {
            if (std::ranges::none_of(partition.boxes, [&](const CellBox& box) {
                    return box.lo[axis] < plane && plane < box.hi[axis];
                })) {
                return false;
            }
        }
    }
    return true;
}

TEST(Pinwheels, canBeMadeByNoKdTree) {
    EXPECT_TRUE(everyPlaneCutsABox(kFigure11));
    EXPECT_TRUE(everyPlaneCutsABox(kSolid));
    EXPECT_TRUE(everyPlaneCutsABox(nestedPinwheels({20, 30, 25}, 30, 1)));
}

TEST(Tiling, isAccepted) {
    EXPECT_NO_THROW(checkTiling(kFigure11));
    EXPECT_NO_THROW(checkTiling(kSolid));
    EXPECT_NO_THROW(checkTiling({{1, 1, 1}, {{ivec3(0), ivec3(1)}}}));
    EXPECT_NO_THROW(checkTiling(nestedPinwheels({20, 30, 25}, 30, 1)));
    EXPECT_NO_THROW(checkTiling(nestedPinwheels({1023, 7, 3}, 5, 2)));
}

void expectRefused(const Partition& partition, const std::string& line) {
    EXPECT_EQ(lineOfError(ErrorKind::inputRefused, [&] { checkTiling(partition); }), line);
}

TEST(Tiling, namesAGap) {
    Partition partition = kFigure11;
    partition.boxes.pop_back();
    expectRefused(partition, "no box holds cell 1 1 0");
    expectRefused({{2, 1, 3}, {}}, "no box holds cell 0 0 0");
    expectRefused({{2, 1, 3}, {{{0, 0, 0}, {2, 1, 2}}, {{0, 0, 2}, {1, 1, 3}}}}, "no box holds cell 1 0 2");
}

TEST(Tiling, namesAnOverlap) {
    Partition partition = kFigure11;
    partition.boxes[0].hi.y = 2;
    expectRefused(partition, "box 3 overlaps box 0 at cell 0 1 0");
    partition = kSolid;
    partition.boxes.push_back(partition.boxes[2]);
    expectRefused(partition, "box 5 overlaps box 2 at cell 1 0 0");
}

TEST(Tiling, namesABoxThatIsNone) {
    Partition partition = kFigure11;
    partition.boxes[4].hi.x = 1;
    expectRefused(partition, "box 4, from 1 1 0 to 1 2 1, holds no cell");
    partition = kFigure11;
    partition.boxes[1].hi.z = 2;
    expectRefused(partition, "box 1, from 2 0 0 to 3 2 2, leaves the lattice of 3 3 1 cells");
    partition.boxes[1] = {{2, -1, 0}, {3, 2, 1}};
    expectRefused(partition, "box 1, from 2 -1 0 to 3 2 1, leaves the lattice of 3 3 1 cells");
}

// A scene in its own lattice, with the triangle corners that the builder gets.
struct Placed {
    Placed(Scene usedScene, const Partition& partition) : scene(std::move(usedScene)) {
        AccelerationOptions options;
        options.partition = partition;
        lattice = makeLattice(boundsOf(scene), static_cast<std::uint32_t>(ids.size()), options).lattice;
        for (const std::uint32_t id : ids) {
            const uvec3 indices = scene.triangles[id];
            corners.push_back({toLattice(lattice, scene.positions[indices.x]),
                               toLattice(lattice, scene.positions[indices.y]),
                               toLattice(lattice, scene.positions[indices.z])});
        }
    }

    Scene scene;
    std::vector<std::uint32_t> ids = nonDegenerateTriangles(scene);
    Lattice lattice{};
    std::vector<LatticeTriangle> corners;
};

TEST(Listing, holdsTheTrianglesThatMeetTheGrownBox) {
    const Partition partition = nestedPinwheels({24, 20, 17}, 40, 3);
    const Placed placed(triangleSoup(400, 2), partition);
    const LeafList list = listTriangles(placed.lattice, partition.boxes, placed.corners, placed.ids);
    ASSERT_EQ(list.leaves.size(), partition.boxes.size());
    const glm::dvec3 margin = referenceMargin(placed.lattice);
    std::size_t next = 0;
    for (std::size_t leafId = 0; leafId < list.leaves.size(); ++leafId) {
        const Leaf& leaf = list.leaves[leafId];
        const CellBox& box = partition.boxes[leafId];
        EXPECT_EQ(boxOf(leaf).lo, box.lo);
        EXPECT_EQ(boxOf(leaf).hi, box.hi);
        EXPECT_EQ(leaf.firstTriangle, next);
        next += leaf.triangleCount;
        const auto listed = list.trianglesOf(leaf);
        EXPECT_TRUE(std::ranges::is_sorted(listed));
        for (std::size_t i = 0; i < placed.ids.size(); ++i) {
            const double side = std::ranges::binary_search(listed, placed.ids[i]) ? 1.0 : -1.0;
            const glm::dvec3 grown = margin * (1.0 + side * kMarginRounding);
            ASSERT_EQ(overlaps(placed.corners[i], {glm::dvec3(box.lo) - grown, glm::dvec3(box.hi) + grown}),
                      side > 0.0)
                << "triangle " << placed.ids[i] << " and box " << leafId;
        }
    }
    EXPECT_EQ(next, list.leafTriangles.size());
}

TEST(Listing, namesTheTriangleThatABoxLacks) {
    const Partition partition = nestedPinwheels({24, 20, 17}, 40, 3);
    const Placed placed(triangleSoup(400, 2), partition);
    LeafList list = listTriangles(placed.lattice, partition.boxes, placed.corners, placed.ids);
    EXPECT_NO_THROW(checkListing(placed.lattice, list, placed.corners, placed.ids));
    const auto full =
        std::ranges::find_if(list.leaves, [](const Leaf& leaf) { return leaf.triangleCount > 2; });
    ASSERT_NE(full, list.leaves.end());
    const std::uint32_t lost = list.trianglesOf(*full).back();
    --full->triangleCount;
    EXPECT_EQ(lineOfError(ErrorKind::inputRefused,
                          [&] { checkListing(placed.lattice, list, placed.corners, placed.ids); }),
              "box " + std::to_string(full - list.leaves.begin()) + " does not list triangle " +
                  std::to_string(lost) + ", which touches it");
}

AccelerationStructure build(const Scene& scene, const Partition& partition, const bool exitBoxes) {
    AccelerationOptions options;
    options.partition = partition;
    options.exitBoxes = exitBoxes;
    return buildAccelerationStructure(scene, options);
}

// Rays through the middle of the cube's lower left cells, with results worked out by hand.
TEST(Marching, aPinwheelHasTheKnownHitsAndSteps) {
    struct Known {
        glm::vec3 origin;
        glm::vec3 dir;
        float t;
        std::uint32_t steps; // number of boxes on the way to the far side of the cube
    };
    Scene scene = unitCube();
    const std::size_t faces = scene.triangles.size();
    // Keep only the far walls of the cube, those at 1, so that rays from 0 upwards cross all boxes.
    std::erase_if(scene.triangles, [&](const uvec3& indices) {
        glm::vec3 lowest(1.0f);
        for (int i = 0; i < 3; ++i) {
            lowest = glm::min(lowest, scene.positions[indices[i]]);
        }
        return largest(lowest) < 1.0f;
    });
    ASSERT_EQ(scene.triangles.size(), faces / 2);
    const Known flat[] = {
        {{-1, 0.2f, 0.5f}, {1, 0, 0}, 2, 2},          // lower arm, right arm
        {{-1, 0.5f, 0.5f}, {1, 0, 0}, 2, 3},          // left arm, middle, right arm
        {{-1, 0.8f, 0.5f}, {1, 0, 0}, 2, 2},          // left arm, upper arm
        {{0.2f, 0.9f, -3}, {0, 0, 2}, 2, 1},          // left arm
        {{-1, -0.9f, 0.5f}, {0.5f, 0.5f, 0}, 3.8f, 4} // diagonal: lower arm, left arm, middle, upper arm
    };
    const Known solid[] = {
        {{-1, 0.2f, 0.8f}, {1, 0, 0}, 2, 1}, // in the beam along x
        {{0.8f, -1, 0.2f}, {0, 1, 0}, 2, 1}, // in the beam along y
        {{0.2f, 0.8f, -1}, {0, 0, 1}, 2, 1}, // in the beam along z
        {{-1, 0.2f, 0.2f}, {1, 0, 0}, 2, 2}, // corner at 0, beam along y
        {{-1, 0.8f, 0.8f}, {1, 0, 0}, 2, 2}, // beam along z, corner at 1
    };
    const auto expectKnown = [&](const Partition& partition, const std::span<const Known> rays) {
        const AccelerationStructure structure = build(scene, partition, false);
        for (const Known& known : rays) {
            const Ray ray = makeRay(structure.lattice, known.origin, 0.0f, known.dir, kFarthest);
            const TraceResult trace = traceMetaTable(structure, ray, HitQuery::closest);
            EXPECT_NE(trace.hit.triangleId, kNoTriangle);
            EXPECT_NEAR(trace.hit.t + ray.shift, known.t, 1e-6f);
            EXPECT_EQ(trace.steps, known.steps)
                << "from " << known.origin.x << " " << known.origin.y << " " << known.origin.z;
        }
    };
    expectKnown(kFigure11, flat);
    expectKnown(kSolid, solid);
}

// Every ray must find the same hit as brute force, to the bit.
void expectTheHitsOfBruteForce(const Scene& scene, const AccelerationStructure& structure) {
    const std::vector<TriangleRecord> triangles = makeTriangleRecords(scene, nonDegenerateTriangles(scene));
    std::size_t hits = 0;
    for (const RayQuery& query : trickyRays(scene, structure, 20000, 5)) {
        const Ray ray = makeRay(structure.lattice, query.origin, query.tMin, query.dir, query.tMax);
        const Hit expected = traceBruteForce(triangles, ray, HitQuery::closest).hit;
        const Hit hit = traceMetaTable(structure, ray, HitQuery::closest).hit;
        ASSERT_EQ(hit.triangleId, expected.triangleId) << describe(query);
        ASSERT_EQ(floatBitsToUint(hit.t), floatBitsToUint(expected.t)) << describe(query);
        ASSERT_EQ(traceMetaTable(structure, ray, HitQuery::any).hit.triangleId == kNoTriangle,
                  expected.triangleId == kNoTriangle)
            << describe(query);
        hits += expected.triangleId != kNoTriangle ? 1 : 0;
    }
    EXPECT_GT(hits, 1000u);
}

TEST(Marching, pinwheelsLoseNoHit) {
    const Scene scene = triangleSoup(700, 6);
    for (const bool exitBoxes : {false, true}) {
        SCOPED_TRACE(exitBoxes);
        expectTheHitsOfBruteForce(scene, build(scene, kFigure11, exitBoxes));
        expectTheHitsOfBruteForce(scene, build(scene, kSolid, exitBoxes));
        expectTheHitsOfBruteForce(scene, build(scene, nestedPinwheels({31, 28, 40}, 20, 4), exitBoxes));
    }
}

TEST(Marching, aPartitionOfAnEmptySceneHitsNothing) {
    const AccelerationStructure structure = build({}, kSolid, true);
    EXPECT_EQ(structure.lattice.resolution, kSolid.resolution);
    const Ray ray = makeRay(structure.lattice, vec3(-1, 0.5f, 0.5f), 0.0f, vec3(1, 0, 0), kFarthest);
    EXPECT_EQ(traceMetaTable(structure, ray, HitQuery::closest).hit.triangleId, kNoTriangle);
}

std::vector<CellBox> boxesOf(const LeafList& list) {
    std::vector<CellBox> boxes;
    boxes.reserve(list.leaves.size());
    for (const Leaf& leaf : list.leaves) {
        boxes.push_back(boxOf(leaf));
    }
    return boxes;
}

TEST(Merging, joinsLeavesThatFormABox) {
    Lattice lattice{};
    lattice.resolution = uvec3(4, 2, 1);
    lattice.cellCount = 8;
    lattice.cellsPerUnit = vec3(1.0f);
    const auto leaf = [](const uvec3 lo, const uvec3 hi, const std::uint32_t first,
                         const std::uint32_t count) {
        return Leaf{packCell(lo), packCell(hi), first, count};
    };
    // Two leaves with equal lists, a third beside them with more triangles, and an empty one above all of
    // them.
    const LeafList list{{leaf({0, 0, 0}, {1, 1, 1}, 0, 2), leaf({1, 0, 0}, {2, 1, 1}, 2, 2),
                         leaf({2, 0, 0}, {4, 1, 1}, 4, 4), leaf({0, 1, 0}, {4, 2, 1}, 8, 0)},
                        {3, 5, 3, 5, 6, 7, 8, 9}};
    const LeafList merged = mergeLeaves(lattice, list);
    ASSERT_EQ(merged.leaves.size(), 3u);
    EXPECT_EQ(boxOf(merged.leaves[0]).lo, ivec3(0, 0, 0));
    EXPECT_EQ(boxOf(merged.leaves[0]).hi, ivec3(2, 1, 1));
    EXPECT_EQ(merged.leafTriangles, (std::vector<std::uint32_t>{3, 5, 6, 7, 8, 9}));
}

TEST(Merging, leavesAPartitionThatListsItsTriangles) {
    AccelerationOptions options;
    options.mergeLeaves = true;
    const Scene scene = triangleSoup(700, 6);
    const AccelerationStructure structure = buildAccelerationStructure(scene, options);
    const LeafList merged = mergeLeaves(structure.lattice, structure.tree);
    EXPECT_LT(merged.leaves.size(), structure.tree.leaves.size());
    ASSERT_EQ(structure.table.leaves.size(), merged.leaves.size());
    const Partition partition{structure.lattice.resolution, boxesOf(merged)};
    EXPECT_NO_THROW(checkTiling(partition));
    std::vector<LatticeTriangle> corners;
    const std::vector<std::uint32_t> ids = nonDegenerateTriangles(scene);
    for (const TriangleRecord& triangle : makeTriangleRecords(scene, ids)) {
        corners.push_back({toLattice(structure.lattice, triangle.v0),
                           toLattice(structure.lattice, triangle.v1),
                           toLattice(structure.lattice, triangle.v2)});
    }
    EXPECT_NO_THROW(checkListing(structure.lattice, merged, corners, ids));
    expectTheHitsOfBruteForce(scene, structure);
}

class PartitionFile : public testing::Test {
  protected:
    void expectRefused(const ErrorKind kind, const std::string& content, const std::string& what) {
        std::ofstream(file) << content;
        EXPECT_EQ(lineOfError(kind, [&] { readPartition(file); }), file.string() + ": " + what) << content;
    }
    void expectRefused(const std::string& content, const std::string& what) {
        expectRefused(ErrorKind::inputRefused, content, what);
    }

    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "boxes.json";
};

TEST_F(PartitionFile, isRead) {
    std::ofstream(file) << R"({"resolution": [2, 1, 1], "boxes": [[0,0,0, 1,1,1], [1,0,0, 2,1,1]]})";
    const Partition partition = readPartition(file);
    EXPECT_EQ(partition.resolution, uvec3(2, 1, 1));
    ASSERT_EQ(partition.boxes.size(), 2u);
    EXPECT_EQ(partition.boxes[1].lo, ivec3(1, 0, 0));
    EXPECT_EQ(partition.boxes[1].hi, ivec3(2, 1, 1));
}

TEST_F(PartitionFile, isRefusedInOneLine) {
    expectRefused("boxes", "is no JSON, at byte 1");
    expectRefused("[1, 2]", "is not an object of a \"resolution\" and a list of \"boxes\"");
    expectRefused(R"({"resolution": [1,1,1]})",
                  "is not an object of a \"resolution\" and a list of \"boxes\"");
    expectRefused(R"({"resolution": [1,1,1], "boxes": [], "box": []})",
                  "is not an object of a \"resolution\" and a list of \"boxes\"");
    expectRefused(R"({"resolution": [1,1], "boxes": []})",
                  "the resolution is not 3 whole numbers from 0 to 1023");
    expectRefused(R"({"resolution": [1,1,1024], "boxes": []})",
                  "the resolution is not 3 whole numbers from 0 to 1023");
    expectRefused(R"({"resolution": [1,0,1], "boxes": []})", "the resolution has no cells on an axis");
    for (const char* const box : {"7", "[0,0,0,1,1]", "[0,0,0,1,1,1,1]", "[0,0,-1,1,1,1]", "[0,0,0,1,1,1.5]",
                                  "[0,0,0,1,1,99999999999]", "[0,0,0,1,1,null]"}) {
        expectRefused(std::string(R"({"resolution": [1,1,1], "boxes": [[0,0,0,1,1,1], )") + box + "]}",
                      "box 1 is not 6 whole numbers from 0 to 1023");
    }
    expectRefused(R"({"resolution": [2,1,1], "boxes": [[0,0,0,1,1,1]]})", "no box holds cell 1 0 0");
    expectRefused(ErrorKind::outOfMemory, R"({"resolution": [1023,1023,1023], "boxes": []})",
                  "a meta table of 1023 x 1023 x 1023 cells takes 4084 MiB, more than the 1024 MiB allowed");
}

} // namespace
} // namespace metamarch::tests
