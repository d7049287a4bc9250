// SPDX-License-Identifier: MIT
// The rays of the benchmarks: the same on every machine and in every run.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/trace.h"
#include "metamarch/scene/scene.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/ray_query.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch::bench {

struct RaySet {
    std::vector<RayQuery> rays;
    HitQuery query = HitQuery::closest;
};

struct RaySetKind {
    std::string_view name;
    std::string_view meaning;
};

inline constexpr std::array<RaySetKind, 7> kRaySets{{
    {"far", "camera rays of the four axis views, 1.5 box diagonals from the centre"},
    {"close", "the same from 0.7 box diagonals"},
    {"ao", "one cosine-distributed ray from each hit of close, a tenth of the box diagonal long, any hit"},
    {"shadow", "from each hit of close to a light outside the box, any hit"},
    {"mirror", "from each hit of close, reflected at the triangle's plane"},
    {"diffuse", "one cosine-distributed ray from each hit of close"},
    {"random", "as many as close has, from points uniform in the box in uniform directions"},
}};

std::vector<std::string> raySetNames();

// Makes the set of kRaySets called `name`; views have width x height pixels.
RaySet makeRaySet(std::string_view name, const Scene& scene, const AccelerationStructure& structure,
                  std::uint32_t width, std::uint32_t height);

// Returns the rays through the centres of the camera's pixels, in the order in which the kernel `primary`
// traces them: in tiles of 8 x 8, so that neighbours in memory are neighbours in the picture.
std::vector<RayQuery> cameraRays(const Camera& camera);

// Returns `count` rays with uniform origins in the lattice's box and uniform directions.
RaySet randomRays(const Lattice& lattice, std::size_t count);

} // namespace metamarch::bench
