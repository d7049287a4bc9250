// SPDX-License-Identifier: MIT
// Vulkan lets a device round floats to zero. Every traversal then still finds the hits of brute force, to
// the bit. The twins read the shaders' own headers, and a processor rounds as it is told.
#include "fixtures/ray_sets.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/bench/hit_check.h"
#include "metamarch/reference/twins.h"
#include "metamarch/scene/import.h"

#include <gtest/gtest.h>

#include <cfenv>

namespace metamarch::tests {
namespace {

class RoundsToZero {
  public:
    RoundsToZero() { std::fesetround(FE_TOWARDZERO); }
    ~RoundsToZero() { std::fesetround(FE_TONEAREST); }
    RoundsToZero(const RoundsToZero&) = delete;
    RoundsToZero& operator=(const RoundsToZero&) = delete;
};

template <class Judge>
std::vector<RayResult> traced(const Lattice& lattice, const std::vector<RayQuery>& rays, const Judge& judge) {
    std::vector<RayResult> results;
    for (const RayQuery& query : rays) {
        const Ray ray = makeRay(lattice, query.origin, query.tMin, query.dir, query.tMax);
        const TraceResult trace = judge(ray);
        results.push_back(rayResult(ray, trace.hit, trace.steps, trace.tests));
    }
    return results;
}

class Truncation : public testing::TestWithParam<const char*> {};

TEST_P(Truncation, losesNoHit) {
    const Scene scene = loadScene(std::string(METAMARCH_SOURCE_DIR "/scenes/") + GetParam());
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const StructureSet structures(structure);
    const std::vector<RayQuery> rays = trickyRays(scene, structure, 10000, 5);
    const auto hitsOf = [&](const std::string_view traversal) {
        return traced(structure.lattice, rays, [&](const Ray& ray) {
            return findTwin(traversal).unchecked(structures, ray, HitQuery::closest);
        });
    };
    const std::vector<RayResult> nearest = hitsOf("brute_force");
    const RoundsToZero truncated;
    const std::vector<RayResult> expected = hitsOf("brute_force");
    EXPECT_GT(bench::countDifferent(rays, expected, nearest, HitQuery::closest, {}), rays.size() / 100)
        << "nothing is truncated";
    for (const Twin& twin : twins()) {
        EXPECT_EQ(bench::countDifferent(rays, hitsOf(twin.traversal), expected, HitQuery::closest, {}), 0u)
            << twin.traversal;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Truncation, testing::Values("objects.glb", "cornell.glb"));

} // namespace
} // namespace metamarch::tests
