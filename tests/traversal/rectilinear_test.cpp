// SPDX-License-Identifier: MIT
// Rays towards the uneven planes of the rectilinear table, which other ray sets do not hit. The table's twin,
// which asserts its invariants, is compared with brute force.
#include "fixtures/named_scene.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/structure_set.h"
#include "metamarch/reference/twins.h"
#include "traversal/judges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace metamarch::tests {
namespace {

constexpr std::size_t kRays = 60000;

class PlaneRays {
  public:
    PlaneRays(const Lattice& usedLattice, const RectilinearPlanes& usedPlanes)
        : lattice(usedLattice), planes(usedPlanes) {}

    // Makes a ray from a corner of cells or near one, to another corner, along an axis, or in a plane of two
    // axes.
    RayQuery make() {
        const vec3 origin = corner();
        vec3 dir = corner() - origin;
        const int axis = static_cast<int>(integer(3));
        switch (integer(3)) {
        case 0:
            dir = vec3(integer(2) == 0 ? 0.0f : -0.0f);
            dir[axis] = integer(2) == 0 ? 1.0f : -1.0f;
            break;
        case 1:
            dir[axis] = integer(2) == 0 ? 0.0f : -0.0f;
            break;
        default:
            break;
        }
        return {origin, 0.0f, dir, kFarthest};
    }

  private:
    unsigned integer(const unsigned end) {
        return std::uniform_int_distribution<unsigned>(0, end - 1)(random);
    }

    // Returns the corner as floats, or a neighbouring float.
    vec3 corner() {
        vec3 result;
        for (int axis = 0; axis < 3; ++axis) {
            const auto index = static_cast<int>(integer(planes.layout().resolution[axis] + 1));
            const float at = lattice.origin[axis] + planes.plane(axis, index) / lattice.cellsPerUnit[axis];
            const float beside = std::nextafter(at, integer(2) == 0 ? kFarthest : -kFarthest);
            result[axis] = integer(2) == 0 ? at : beside;
        }
        return result;
    }

    const Lattice& lattice;
    const RectilinearPlanes& planes;
    std::mt19937 random{12};
};

class Rectilinear : public testing::TestWithParam<NamedScene> {};

TEST_P(Rectilinear, findsWhatBruteForceFindsFromPlaneToPlane) {
    const Scene scene = GetParam().make();
    for (const bool exitBoxes : {true, false}) {
        SCOPED_TRACE(exitBoxes ? "exit boxes" : "no exit boxes");
        AccelerationOptions options;
        options.table = TableMethod::rectilinear;
        options.exitBoxes = exitBoxes;
        const AccelerationStructure structure = buildAccelerationStructure(scene, options);
        const StructureSet structures(structure);
        PlaneRays maker(structure.lattice, structures.rectilinearTable().planes);
        std::vector<RayQuery> rays(kRays);
        std::ranges::generate(rays, [&] { return maker.make(); });
        for (const HitQuery query : {HitQuery::closest, HitQuery::any}) {
            const auto brute = traceAll(structure.lattice, rays, [&](const Ray& ray) {
                return traceBruteForce(structures.triangles(), ray, query);
            });
            const auto results = traceAll(structure.lattice, rays, [&](const Ray& ray) {
                return findTwin("rectilinear_table").checked(structures, ray, query);
            });
            if (query == HitQuery::closest) {
                expectSameHits(rays, results, brute, Counters::ignored);
            } else {
                expectSameOcclusion(rays, results, brute);
            }
        }
    }
}

// The worst case for a uniform lattice: all of the detail is in a millionth of the floor.
Scene sphereInStadium() { return sphereOnFloor(30, 15, 1e4f); }

INSTANTIATE_TEST_SUITE_P(Scenes, Rectilinear,
                         testing::Values(NamedScene{"empty", noTriangles},
                                         NamedScene{"one_triangle", oneTriangle},
                                         NamedScene{"unit_cube", unitCube},
                                         NamedScene{"soup", [] { return triangleSoup(500, 9); }},
                                         NamedScene{"sphere_in_stadium", sphereInStadium}),
                         [](const auto& instance) { return std::string(instance.param.name); });

// A leaf of a uniform lattice holds hundreds of triangles in this scene; the uneven cells give the sphere its
// share of the cells.
TEST(RectilinearInAStadium, testsFewTriangles) {
    const AccelerationStructure structure = buildAccelerationStructure(sphereInStadium(), {});
    const StructureSet structures(structure);
    const std::vector<RayQuery> rays = {{{0.3f, 1.2f, 5.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, kFarthest}};
    const auto uniform = traceAll(structure.lattice, rays, [&](const Ray& ray) {
        return traceKdStack(structure, ray, HitQuery::closest);
    });
    const auto uneven = traceAll(structure.lattice, rays, [&](const Ray& ray) {
        return findTwin("rectilinear_table").checked(structures, ray, HitQuery::closest);
    });
    expectSameHits(rays, uneven, uniform, Counters::ignored);
    EXPECT_GT(uniform[0].tests, 500u);
    EXPECT_LT(uneven[0].tests, 20u);
}

} // namespace
} // namespace metamarch::tests
