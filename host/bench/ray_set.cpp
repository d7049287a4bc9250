// SPDX-License-Identifier: MIT
#include "metamarch/bench/ray_set.h"

#include "metamarch/bench/random_numbers.h"
#include "metamarch/bench/secondary_rays.h"
#include "metamarch/bench/views.h"
#include "metamarch/shared/primary.h"

#include <algorithm>
#include <stdexcept>

namespace metamarch::bench {
namespace {

constexpr float kFarDiagonals = 1.5f;
constexpr float kCloseDiagonals = 0.7f;
constexpr std::uint64_t kRandomSeed = 1;

std::vector<RayQuery> axisViewRays(const Scene& scene, const float diagonals, const std::uint32_t width,
                                   const std::uint32_t height) {
    std::vector<RayQuery> rays;
    for (const AxisView& view : kAxisViews) {
        const std::vector<RayQuery> of =
            cameraRays(makeCamera(axisCamera(scene, view, diagonals), width, height));
        rays.insert(rays.end(), of.begin(), of.end());
    }
    return rays;
}

} // namespace

std::vector<std::string> raySetNames() {
    std::vector<std::string> names;
    names.reserve(kRaySets.size());
    for (const RaySetKind& kind : kRaySets) {
        names.emplace_back(kind.name);
    }
    return names;
}

std::vector<RayQuery> cameraRays(const Camera& camera) {
    std::vector<RayQuery> rays;
    rays.reserve(std::size_t{camera.width} * camera.height);
    for (uint top = 0; top < camera.height; top += kTileSide) {
        for (uint left = 0; left < camera.width; left += kTileSide) {
            for (uint i = 0; i < kTilePixels; ++i) {
                const uvec2 pixel = uvec2(left, top) + pixelInTile(i);
                if (pixel.x < camera.width && pixel.y < camera.height) {
                    const CameraRay view = cameraRay(camera, pixel.x, pixel.y);
                    rays.push_back({view.origin, 0.0f, view.dir, kFarthest});
                }
            }
        }
    }
    return rays;
}

RaySet randomRays(const Lattice& lattice, const std::size_t count) {
    const glm::vec3 size = glm::vec3(lattice.resolution) / lattice.cellsPerUnit;
    RaySet set;
    set.rays.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        RandomNumbers random(kRandomSeed, i);
        const glm::vec3 origin = lattice.origin + size * random.inUnitCube();
        set.rays.push_back({origin, 0.0f, random.onSphere(), kFarthest});
    }
    return set;
}

RaySet makeRaySet(const std::string_view name, const Scene& scene, const AccelerationStructure& structure,
                  const std::uint32_t width, const std::uint32_t height) {
    if (name == "far") {
        return {axisViewRays(scene, kFarDiagonals, width, height)};
    }
    if (name == "random") {
        return randomRays(structure.lattice, kAxisViews.size() * width * height);
    }
    const std::vector<RayQuery> close = axisViewRays(scene, kCloseDiagonals, width, height);
    if (name == "close") {
        return {close};
    }
    const std::vector<SurfacePoint> points = surfacePoints(structure, close);
    if (name == "ao") {
        return ambientRays(structure.lattice, points);
    }
    if (name == "shadow") {
        return shadowRays(structure.lattice, points);
    }
    if (name == "mirror") {
        return mirrorRays(structure.lattice, points);
    }
    if (name == "diffuse") {
        return diffuseRays(structure.lattice, points);
    }
    throw std::logic_error("no such ray set");
}

} // namespace metamarch::bench
