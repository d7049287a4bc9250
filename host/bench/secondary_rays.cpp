// SPDX-License-Identifier: MIT
#include "metamarch/bench/secondary_rays.h"

#include "metamarch/bench/cpu_tracer.h"
#include "metamarch/bench/random_numbers.h"

#include <cmath>

namespace metamarch::bench {
namespace {

constexpr float kAmbientReach = 0.1f; // fraction of the box's diagonal
constexpr std::uint64_t kAmbientSeed = 2;
constexpr std::uint64_t kDiffuseSeed = 3;

// Relative to the centre of the box, in box diagonals. It lies outside any box, above and to the right.
constexpr glm::vec3 kLightPlace{0.5f, 0.8f, 0.4f};

glm::vec3 boxSize(const Lattice& lattice) { return glm::vec3(lattice.resolution) / lattice.cellsPerUnit; }

// Computes in double precision and then projects onto the triangle's plane: for a distant camera the float t
// is too coarse.
SurfacePoint surfacePoint(const RayQuery& ray, const float t, const TriangleRecord& triangle) {
    const glm::dvec3 v0(triangle.v0);
    const glm::dvec3 across = glm::cross(glm::dvec3(triangle.v1) - v0, glm::dvec3(triangle.v2) - v0);
    const glm::dvec3 incoming = glm::normalize(glm::dvec3(ray.dir));
    const glm::dvec3 unit = glm::normalize(across);
    const glm::dvec3 normal = glm::dot(unit, incoming) > 0.0 ? -unit : unit;
    const glm::dvec3 reached = glm::dvec3(ray.origin) + glm::dvec3(ray.dir) * static_cast<double>(t);
    return {glm::vec3(reached - normal * glm::dot(reached - v0, normal)), glm::vec3(normal),
            glm::vec3(incoming)};
}

// Rotates `v` from the frame of +z to that of `normal`. T. Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 6(1), 2017.
glm::vec3 turnTo(const glm::vec3 normal, const glm::vec3 v) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    const glm::vec3 tangent(1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const glm::vec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    return tangent * v.x + bitangent * v.y + normal * v.z;
}

RaySet cosineRays(const Lattice& lattice, const std::span<const SurfacePoint> points,
                  const std::uint64_t seed, const float tMax, const HitQuery query) {
    RaySet set{{}, query};
    set.rays.reserve(points.size());
    for (const SurfacePoint& point : points) {
        RandomNumbers random(seed, set.rays.size());
        set.rays.push_back({startAbove(lattice, point), 0.0f, turnTo(point.normal, random.aroundZ()), tMax});
    }
    return set;
}

} // namespace

std::vector<SurfacePoint> surfacePoints(const AccelerationStructure& structure,
                                        const std::span<const RayQuery> rays) {
    const Judgement judged = judge(structure, rays, HitQuery::closest);
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (judged.recordIndices[i] != kNoRecord) {
            points.push_back(
                surfacePoint(rays[i], judged.results[i].t, structure.triangles[judged.recordIndices[i]]));
        }
    }
    return points;
}

glm::vec3 startAbove(const Lattice& lattice, const SurfacePoint& point) {
    return point.position + point.normal * (kOffset * (largest(abs(point.position)) + lattice.extent));
}

RaySet ambientRays(const Lattice& lattice, const std::span<const SurfacePoint> points) {
    return cosineRays(lattice, points, kAmbientSeed, kAmbientReach * glm::length(boxSize(lattice)),
                      HitQuery::any);
}

RaySet diffuseRays(const Lattice& lattice, const std::span<const SurfacePoint> points) {
    return cosineRays(lattice, points, kDiffuseSeed, kFarthest, HitQuery::closest);
}

RaySet shadowRays(const Lattice& lattice, const std::span<const SurfacePoint> points) {
    const glm::vec3 size = boxSize(lattice);
    const glm::vec3 light = lattice.origin + 0.5f * size + kLightPlace * glm::length(size);
    RaySet set{{}, HitQuery::any};
    set.rays.reserve(points.size());
    for (const SurfacePoint& point : points) {
        const glm::vec3 start = startAbove(lattice, point);
        set.rays.push_back({start, 0.0f, light - start, 1.0f}); // the light is at t = 1
    }
    return set;
}

RaySet mirrorRays(const Lattice& lattice, const std::span<const SurfacePoint> points) {
    RaySet set;
    set.rays.reserve(points.size());
    for (const SurfacePoint& point : points) {
        const glm::vec3 dir = point.incoming - 2.0f * glm::dot(point.incoming, point.normal) * point.normal;
        set.rays.push_back({startAbove(lattice, point), 0.0f, dir, kFarthest});
    }
    return set;
}

} // namespace metamarch::bench
