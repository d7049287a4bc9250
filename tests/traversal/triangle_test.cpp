// SPDX-License-Identifier: MIT
// Compares the triangle test with double precision, and checks the two properties that traversals rely on:
// there are no gaps between neighbours, and hits are near their triangle.
#include "fixtures/ray_sets.h"
#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/trace.h"
#include "metamarch/shared/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace metamarch::tests {
namespace {

TEST(DifferenceOfProducts, isRightToAFewUlps) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (int i = 0; i < 100000; ++i) {
        const float a = unit(random);
        const float b = unit(random);
        // Every other pair of products nearly cancels.
        const float c = i % 2 == 0 ? a * (1.0f + 1e-6f * unit(random)) : unit(random);
        const float d = i % 2 == 0 ? b : unit(random);
        const double exact = double{a} * b - double{c} * d; // each product is exact in double precision
        EXPECT_NEAR(differenceOfProducts(a, b, c, d), exact, 4 * 0x1p-24 * std::abs(exact));
        EXPECT_EQ(differenceOfProducts(a, b, a, b), 0.0f);
    }
}

struct ExactHit {
    double t;
    double margin; // smallest barycentric coordinate: negative outside, 0 on an edge
};

// Uses the formula of Möller and Trumbore, 1997, in double precision, not the one under test.
ExactHit intersectExactly(const Ray& ray, const std::array<glm::vec3, 3>& triangle) {
    const glm::dvec3 e1 = glm::dvec3(triangle[1]) - glm::dvec3(triangle[0]);
    const glm::dvec3 e2 = glm::dvec3(triangle[2]) - glm::dvec3(triangle[0]);
    const glm::dvec3 s = glm::dvec3(ray.origin) - glm::dvec3(triangle[0]);
    const glm::dvec3 p = glm::cross(glm::dvec3(ray.dir), e2);
    const glm::dvec3 q = glm::cross(s, e1);
    const double det = glm::dot(e1, p);
    const double u = glm::dot(s, p) / det;
    const double v = glm::dot(glm::dvec3(ray.dir), q) / det;
    return {glm::dot(e2, q) / det, std::min({u, v, 1.0 - u - v})};
}

// Nearest point of a triangle: C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5, by projecting
// onto the plane and, outside, onto the edges.
double distanceToTriangle(const glm::dvec3 p, const std::array<glm::vec3, 3>& triangle) {
    const std::array<glm::dvec3, 3> v = {triangle[0], triangle[1], triangle[2]};
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge = v[(i + 1) % 3] - v[i];
        const double along = std::clamp(glm::dot(p - v[i], edge) / glm::dot(edge, edge), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(v[i] + along * edge - p));
    }
    const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
        inside = inside && glm::dot(glm::cross(v[(i + 1) % 3] - v[i], p - v[i]), normal) >= 0.0;
    }
    return inside ? std::min(nearest, std::abs(glm::dot(p - v[0], normal)) / glm::length(normal)) : nearest;
}

// Calls `check(ray, corners, t)` for every pair of a tricky ray and a non-degenerate triangle, t being kNoHit
// or the hit.
template <class Check>
void forEachPair(const Scene& scene, const std::uint32_t rayCount, const Check& check) {
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const std::vector<TriangleRecord> triangles = makeTriangleRecords(scene, nonDegenerateTriangles(scene));
    for (const RayQuery& query : trickyRays(scene, structure, rayCount, 23)) {
        const Ray ray = makeRay(structure.lattice, query.origin, query.tMin, query.dir, query.tMax);
        if (ray.tMax < ray.tMin) {
            continue;
        }
        for (const TriangleRecord& triangle : triangles) {
            const float t = intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2);
            check(ray, std::array{triangle.v0, triangle.v1, triangle.v2}, t);
        }
    }
}

TEST(Triangle, agreesWithDoublePrecision) {
    std::size_t hits = 0;
    forEachPair(triangleSoup(400, 9), 4000, [&](const Ray& ray, const auto& corners, const float t) {
        const ExactHit exact = intersectExactly(ray, corners);
        const glm::dvec3 e1 = glm::dvec3(corners[1]) - glm::dvec3(corners[0]);
        const glm::dvec3 e2 = glm::dvec3(corners[2]) - glm::dvec3(corners[0]);
        const glm::dvec3 normal = glm::cross(e1, e2);
        const double height =
            glm::length(normal) / std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
        const double cosine = std::abs(glm::dot(glm::normalize(normal), glm::normalize(glm::dvec3(ray.dir))));
        // Skip cases that rounding can decide: edge-on triangles, hits at an edge or at the end of the ray.
        if (cosine < 0.05 || std::abs(exact.margin) * height < 1e-5 || std::abs(exact.t - ray.tMin) < 1e-4) {
            return;
        }
        const bool expected = exact.margin > 0.0 && exact.t > ray.tMin;
        EXPECT_EQ(t != kNoHit, expected) << exact.margin << " " << exact.t;
        if (expected && t != kNoHit) {
            ++hits;
            EXPECT_NEAR(t * glm::length(ray.dir), exact.t * glm::length(glm::dvec3(ray.dir)), 1e-5);
        }
    });
    EXPECT_GT(hits, 1000u);
}

void expectHitsAtTheirTriangle(const Scene& scene) {
    const Lattice lattice = buildAccelerationStructure(scene, {}).lattice;
    // The test may use half of the margin; the other half is for the rounding errors of a traversal.
    const double allowed = 0.5 * kReferenceMargin * static_cast<double>(lattice.extent);
    double worst = 0.0;
    std::size_t hits = 0;
    forEachPair(scene, 3000, [&](const Ray& ray, const auto& corners, const float t) {
        if (t != kNoHit) {
            const glm::dvec3 point = glm::dvec3(ray.origin) + static_cast<double>(t) * glm::dvec3(ray.dir);
            worst = std::max(worst, distanceToTriangle(point, corners));
            ++hits;
        }
    });
    EXPECT_LE(worst, allowed) << "of " << hits << " hits";
    EXPECT_GT(hits, 1000u);
    std::cout << hits << " hits, the worst " << worst / allowed << " of what is allowed\n";
}

TEST(Triangle, isHitWhereItIs) { expectHitsAtTheirTriangle(triangleSoup(500, 4)); }

TEST(Triangle, isHitWhereItIsInAStadium) {
    Scene scene;
    addSphere(scene, {0, 1, 0}, 1.0f, 16, 8);
    addPlane(scene, 0.0f, 1e4f);
    expectHitsAtTheirTriangle(scene);
}

TEST(Triangle, isHitWhereItIsThoughSeenAlmostEdgeOn) {
    Scene scene;
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (int i = 0; i < 200; ++i) { // slats that are nearly parallel to one direction
        const glm::vec3 at(unit(random), unit(random), unit(random));
        addTriangle(scene, at, at + glm::vec3(1.0f, 1e-5f * unit(random), 0.5f),
                    at + glm::vec3(0.7f, 1e-6f * unit(random), -0.4f));
    }
    expectHitsAtTheirTriangle(scene);
}

// No ray leaves a closed mesh from the inside, wherever the mesh is. The place is that of Embree's own tests.
class Watertight : public testing::TestWithParam<glm::vec3> {};

TEST_P(Watertight, noRayEscapes) {
    Scene scene;
    addSphere(scene, {0, 0, 0}, 100.0f, 60, 30);
    for (glm::vec3& position : scene.positions) {
        position += GetParam();
    }
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    std::uniform_int_distribution<std::size_t> anyTriangle(0, scene.triangles.size() - 1);
    std::size_t escaped = 0;
    for (int i = 0; i < 300000; ++i) {
        const glm::vec3 origin = GetParam() + 30.0f * glm::vec3(unit(random), unit(random), unit(random));
        const glm::uvec3 indices = scene.triangles[anyTriangle(random)];
        const glm::vec3 vertex = scene.positions[indices.x];
        const glm::vec3 target =
            i % 3 == 0   ? vertex
            : i % 3 == 1 ? glm::mix(vertex, scene.positions[indices.y], 0.5f * unit(random) + 0.5f)
                         : origin + glm::vec3(unit(random), unit(random), unit(random));
        const Ray ray = makeRay(structure.lattice, origin, 0.0f, target - origin, kFarthest);
        escaped += traceMetaTable(structure, ray, HitQuery::closest).hit.triangleId == kNoTriangle ? 1 : 0;
    }
    EXPECT_EQ(escaped, 0u);
}

INSTANTIATE_TEST_SUITE_P(Places, Watertight,
                         testing::Values(glm::vec3(0.0f), glm::vec3(148376.0f, 1234.0f, -223423.0f)));

// Rays within the limits hit; rays outside of them hit nothing.
TEST(RaySetUp, refusesWhatIsNotARay) {
    const AccelerationStructure structure = buildAccelerationStructure(unitCube(), {});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const glm::vec3 at(0.5f, 0.5f, -3.0f);
    const glm::vec3 along(0.0f, 0.0f, 1.0f);
    const auto hits = [&](const glm::vec3 origin, const float tMin, const glm::vec3 dir, const float tMax) {
        const Ray ray = makeRay(structure.lattice, origin, tMin, dir, tMax);
        return traceMetaTable(structure, ray, HitQuery::closest).hit.triangleId != kNoTriangle;
    };
    EXPECT_TRUE(hits(at, 0.0f, along, kFarthest));
    EXPECT_TRUE(hits(at, 0.0f, 1e-9f * along, kFarthest));
    EXPECT_TRUE(hits(at, 0.0f, 1e9f * along, kFarthest));
    EXPECT_FALSE(hits(at, 0.0f, along, 2.9f)) << "ends before the cube";
    EXPECT_FALSE(hits(at, 4.1f, along, kFarthest)) << "begins behind the cube";
    EXPECT_FALSE(hits(at, 0.0f, -along, kFarthest));
    for (const float bad : {nan, infinity, -infinity}) {
        EXPECT_FALSE(hits({bad, 0.5f, -3.0f}, 0.0f, along, kFarthest));
        EXPECT_FALSE(hits(at, bad, along, kFarthest));
        EXPECT_FALSE(hits(at, 0.0f, {0.0f, bad, 1.0f}, kFarthest));
    }
    EXPECT_FALSE(hits(at, 0.0f, along, nan));
    EXPECT_FALSE(hits(at, 0.0f, glm::vec3(0.0f), kFarthest));
}

} // namespace
} // namespace metamarch::tests
