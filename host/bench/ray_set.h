// Rays to measure with: the same on every machine and in every run.
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

// The one of kRaySets that is called `name`; the views are of width x height pixels.
RaySet makeRaySet(std::string_view name, const Scene& scene, const AccelerationStructure& structure,
                  std::uint32_t width, std::uint32_t height);

// The rays through the centres of the camera's pixels, in the order in which the kernel `primary` traces
// them: tiles of 8 x 8, so that rays side by side in memory are side by side in the picture.
std::vector<RayQuery> cameraRays(const Camera& camera);

// `count` rays from points uniform in the lattice's box in uniform directions.
RaySet randomRays(const Lattice& lattice, std::size_t count);

} // namespace metamarch::bench
