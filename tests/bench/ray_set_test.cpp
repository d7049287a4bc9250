// SPDX-License-Identifier: MIT
#include "fixtures/shapes.h"
#include "metamarch/bench/cpu_tracer.h"
#include "metamarch/bench/random_numbers.h"
#include "metamarch/bench/secondary_rays.h"
#include "metamarch/shading/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace metamarch::bench {
namespace {

constexpr std::uint32_t kWidth = 37; // not a multiple of a tile's
constexpr std::uint32_t kHeight = 21;
constexpr std::size_t kViewRays = std::size_t{4} * kWidth * kHeight;

struct SphereAndCube {
    SphereAndCube() {
        tests::addSphere(scene, {0.2f, 1.6f, 0.5f}, 0.5f, 24, 12);
        structure = buildAccelerationStructure(scene, {});
    }

    Scene scene = tests::unitCube();
    AccelerationStructure structure;
};

bool isFinite(const glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

class RaySets : public testing::TestWithParam<RaySetKind> {
  protected:
    RaySet make() { return makeRaySet(GetParam().name, model.scene, model.structure, kWidth, kHeight); }

    SphereAndCube model;
};

TEST_P(RaySets, areTheSameEachTime) {
    const RaySet a = make();
    const RaySet b = make();
    ASSERT_EQ(a.rays.size(), b.rays.size());
    EXPECT_EQ(std::memcmp(a.rays.data(), b.rays.data(), a.rays.size() * sizeof(RayQuery)), 0);
}

TEST_P(RaySets, areFiniteAndAsManyAsTheyShouldBe) {
    const RaySet set = make();
    const std::string_view name = GetParam().name;
    if (name == "far" || name == "close" || name == "random") {
        EXPECT_EQ(set.rays.size(), kViewRays);
    } else {
        const RaySet close = makeRaySet("close", model.scene, model.structure, kWidth, kHeight);
        EXPECT_EQ(set.rays.size(), surfacePoints(model.structure, close.rays).size());
        EXPECT_GT(set.rays.size(), kViewRays / 20);
    }
    for (const RayQuery& ray : set.rays) {
        ASSERT_TRUE(isFinite(ray.origin) && isFinite(ray.dir));
        ASSERT_GT(glm::length(ray.dir), 0.0f);
        ASSERT_LT(ray.tMin, ray.tMax);
    }
    EXPECT_EQ(set.query == HitQuery::any, name == "ao" || name == "shadow");
}

INSTANTIATE_TEST_SUITE_P(Names, RaySets, testing::ValuesIn(kRaySets),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(RaySet, holdsEveryPixelOnce) {
    const SphereAndCube model;
    const Camera camera = makeCamera(frameBounds(boundsOf(model.scene), 0.8f, 2.0f), 19, 10);
    const std::vector<RayQuery> rays = cameraRays(camera);
    ASSERT_EQ(rays.size(), 190u);
    for (std::uint32_t y = 0; y < 10; ++y) {
        for (std::uint32_t x = 0; x < 19; ++x) {
            const glm::vec3 dir = cameraRay(camera, x, y).dir;
            EXPECT_EQ(std::ranges::count(rays, dir, &RayQuery::dir), 1);
        }
    }
}

// A ray that leaves a closed convex body does not hit it again: neither the triangle that it leaves nor its
// neighbours.
TEST(SecondaryRays, doNotMeetTheSurfaceTheyLeave) {
    for (const float distance : {0.0f, 1e3f}) {
        Scene scene;
        tests::addSphere(scene, glm::vec3(distance), 1.0f, 48, 24);
        const AccelerationStructure structure = buildAccelerationStructure(scene, {});
        const RaySet close = makeRaySet("close", scene, structure, 64, 64);
        const std::vector<SurfacePoint> points = surfacePoints(structure, close.rays);
        for (const RaySet& set :
             {diffuseRays(structure.lattice, points), mirrorRays(structure.lattice, points),
              ambientRays(structure.lattice, points)}) {
            for (const RayResult& hit : judge(structure, set.rays, set.query).results) {
                ASSERT_EQ(hit.triangleId, kNoTriangle) << distance;
            }
        }
    }
}

TEST(SecondaryRays, startOnTheSideTheyCameFrom) {
    const SphereAndCube model;
    const RaySet close = makeRaySet("close", model.scene, model.structure, kWidth, kHeight);
    for (const SurfacePoint& point : surfacePoints(model.structure, close.rays)) {
        ASSERT_LE(glm::dot(point.normal, point.incoming), 0.0f);
        ASSERT_NEAR(glm::length(point.normal), 1.0f, 1e-6f);
    }
}

TEST(RandomNumbers, areUniformAndCosineDistributed) {
    constexpr int kCount = 20000;
    glm::vec3 cubeMean(0.0f);
    glm::vec3 sphereMean(0.0f);
    float cosineMean = 0.0f;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        RandomNumbers random(5, i);
        cubeMean += random.inUnitCube() / float(kCount);
        sphereMean += random.onSphere() / float(kCount);
        cosineMean += random.aroundZ().z / float(kCount);
    }
    // The standard errors are below 0.005; the tolerances are more than 4 of them.
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(cubeMean[axis], 0.5f, 0.02f);
        EXPECT_NEAR(sphereMean[axis], 0.0f, 0.02f);
    }
    EXPECT_NEAR(cosineMean, 2.0f / 3.0f, 0.02f); // the integral of cos^2 / pi over the hemisphere
}

} // namespace
} // namespace metamarch::bench
