// SPDX-License-Identifier: MIT
// Rays that start at the hits of other rays.
#pragma once
#include "metamarch/bench/ray_set.h"

#include <span>
#include <vector>

namespace metamarch::bench {

// The point at which a ray hit a triangle.
struct SurfacePoint {
    glm::vec3 position; // within half an ulp per axis of the triangle's plane
    glm::vec3 normal;   // of the triangle; unit length, towards the ray's origin
    glm::vec3 incoming; // direction of the ray; unit length
};

// Returns the hits of `rays` in order, without misses, as the CPU's stack traversal finds them.
std::vector<SurfacePoint> surfacePoints(const AccelerationStructure& structure,
                                        std::span<const RayQuery> rays);

// Returns the origin of a ray that leaves `point`: offset from the plane, on the normal's side, by kOffset
// times the largest coordinate around it, so that the ray does not hit the triangle that it leaves.
//
// The triangle test finds its plane within 9 ulps of the scene box (shared/triangle.h). Position and origin
// are each rounded by half an ulp of the largest coordinate. That makes 10 ulps of 2^-23; kOffset is 16.
glm::vec3 startAbove(const Lattice& lattice, const SurfacePoint& point);
inline constexpr float kOffset = 0x1p-19f;

// Each makes one ray per point; ray_set.h describes their directions.
RaySet ambientRays(const Lattice& lattice, std::span<const SurfacePoint> points);
RaySet shadowRays(const Lattice& lattice, std::span<const SurfacePoint> points);
RaySet mirrorRays(const Lattice& lattice, std::span<const SurfacePoint> points);
RaySet diffuseRays(const Lattice& lattice, std::span<const SurfacePoint> points);

} // namespace metamarch::bench
