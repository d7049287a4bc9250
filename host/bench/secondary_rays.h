// Rays that start where other rays ended.
#pragma once
#include "metamarch/bench/ray_set.h"

#include <span>
#include <vector>

namespace metamarch::bench {

// Where a ray met a triangle.
struct SurfacePoint {
    glm::vec3 position; // within half an ulp per axis of the triangle's plane
    glm::vec3 normal;   // of the triangle, of unit length, towards where the ray came from
    glm::vec3 incoming; // the ray's direction, of unit length
};

// The hits of `rays` in their order, misses left out; found by the CPU's stack traversal.
std::vector<SurfacePoint> surfacePoints(const AccelerationStructure& structure,
                                        std::span<const RayQuery> rays);

// Where a ray from `point` starts: off the plane by kOffset of the largest coordinates around it, on the side
// of the normal, so that it does not meet the triangle that it leaves.
//
// The triangle test finds its plane within 9 ulps of the scene box (shared/triangle.h), the position is
// rounded by half an ulp of its largest coordinate, and so is the start: 10 ulps, of 2^-23. kOffset is 16.
glm::vec3 startAbove(const Lattice& lattice, const SurfacePoint& point);
inline constexpr float kOffset = 0x1p-19f;

// One ray from each point; ray_set.h says where to.
RaySet ambientRays(const Lattice& lattice, std::span<const SurfacePoint> points);
RaySet shadowRays(const Lattice& lattice, std::span<const SurfacePoint> points);
RaySet mirrorRays(const Lattice& lattice, std::span<const SurfacePoint> points);
RaySet diffuseRays(const Lattice& lattice, std::span<const SurfacePoint> points);

} // namespace metamarch::bench
