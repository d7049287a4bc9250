// SPDX-License-Identifier: MIT
// Compares the CPU twin of every traversal with brute force, on scenes made in memory.
#include "fixtures/named_scene.h"
#include "fixtures/ray_sets.h"
#include "fixtures/shapes.h"
#include "metamarch/reference/twins.h"
#include "traversal/judges.h"

#include <gtest/gtest.h>

namespace metamarch::tests {
namespace {

Scene degenerateOnly() {
    Scene scene;
    addTriangle(scene, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    addTriangle(scene, {0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    return scene;
}

// Returns 200 overlapping triangles in one plane.
Scene coplanarHeap() {
    Scene scene;
    for (int i = 0; i < 200; ++i) {
        const float shift = 0.001f * static_cast<float>(i);
        addTriangle(scene, {shift, 0.5f, 0}, {1 + shift, 0.5f, 0}, {shift, 0.5f, 1});
    }
    return scene;
}

Scene sphereInStadium() { return sphereOnFloor(40, 20, 1e4f); }

Scene farAway(const float distance) {
    Scene scene = unitCube();
    addSphere(scene, glm::vec3(0.5f), 0.4f, 24, 12);
    for (glm::vec3& position : scene.positions) {
        position += distance * glm::vec3(1.0f, -0.1f, 0.5f);
    }
    return scene;
}

Scene scaled(const float factor) {
    Scene scene = triangleSoup(500, 3);
    for (glm::vec3& position : scene.positions) {
        position *= factor;
    }
    return scene;
}

AccelerationOptions withUnit(const double unit) { return {glm::dvec3(unit), {}, {}}; }

AccelerationOptions withQuantum(const double quantum) {
    AccelerationOptions options;
    options.table = TableMethod::gcd;
    options.quantum = quantum;
    return options;
}

const NamedScene kScenes[] = {
    {"empty", noTriangles, {}},
    {"one_triangle", oneTriangle, {}},
    {"degenerate_only", degenerateOnly, {}},
    {"coplanar_heap", coplanarHeap, {}},
    {"unit_cube", unitCube, {}},
    {"unit_cube_integer_planes", unitCube, withUnit(0.25)},
    {"unit_cube_one_cell", unitCube, withUnit(5.0)},
    {"unit_cube_anisotropic", unitCube, {glm::dvec3(0.01, 0.3, 0.9), {}, {}}},
    {"unit_cube_no_depth", unitCube, {{}, {}, 0u}},
    {"soup", [] { return triangleSoup(2000, 1); }, {}},
    {"soup_fine", [] { return triangleSoup(2000, 2); }, {{}, 4000000u, kMaxTreeDepth}},
    {"soup_finest",
     [] { return triangleSoup(300, 5); },
     {glm::dvec3(1.0 / 650.0, 0.05, 1.0 / 650.0), {}, {}}},
    {"soup_gcd", [] { return triangleSoup(2000, 1); }, withQuantum(1.0 / 256.0)},
    {"soup_tiny", [] { return scaled(1e-8f); }, {}},
    {"soup_huge", [] { return scaled(1e8f); }, {}},
    {"sphere_in_stadium", sphereInStadium, {}},
    {"far_100", [] { return farAway(100.0f); }, {}},
    {"far_100000", [] { return farAway(1e5f); }, {}},
};

class Judges : public testing::TestWithParam<NamedScene> {};

TEST_P(Judges, agreeOnTrickyRays) {
    const Scene scene = GetParam().make();
    const AccelerationStructure structure = buildAccelerationStructure(scene, GetParam().options);
    const StructureSet structures(structure);
    std::vector<RayQuery> rays = {{{0, 0, 0}, 0, {1, 0, 0}, kFarthest}};
    if (!scene.triangles.empty()) {
        rays = trickyRays(scene, structure, 50000, 7);
    }
    const std::vector<TriangleRecord> triangles = makeTriangleRecords(scene, nonDegenerateTriangles(scene));
    for (const HitQuery query : {HitQuery::closest, HitQuery::any}) {
        const auto brute = traceAll(structure.lattice, rays,
                                    [&](const Ray& ray) { return traceBruteForce(triangles, ray, query); });
        for (const Twin& twin : twins()) {
            SCOPED_TRACE(twin.traversal);
            const auto results = traceAll(structure.lattice, rays, [&](const Ray& ray) {
                return twin.loop.checked(structures, ray, query);
            });
            if (query == HitQuery::closest) {
                expectSameHits(rays, results, brute, Counters::ignored);
            } else {
                expectSameOcclusion(rays, results, brute);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Judges, testing::ValuesIn(kScenes),
                         [](const auto& instance) { return std::string(instance.param.name); });

} // namespace
} // namespace metamarch::tests
