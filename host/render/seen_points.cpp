// SPDX-License-Identifier: MIT
#include "metamarch/render/seen_points.h"

#include "metamarch/error/error.h"
#include "metamarch/reference/pieces.h"
#include "metamarch/shading/view.h"
#include "metamarch/shared/hit_point.h"
#include "metamarch/shared/path.h"

#include <algorithm>
#include <cmath>

namespace metamarch::render {
namespace {

CameraRay firstRay(const Camera& camera, const PathSettings* const path, const uint x, const uint y) {
    if (path == nullptr) {
        return cameraRay(camera, x, y);
    }
    const Path first = cameraPath(camera, *path, x, y, makePixelSample(x, y, 0, path->seed));
    return {first.origin, first.dir};
}

glm::dvec3 pointAt(const Scene& scene, const glm::uvec3& corners, const glm::dvec3& weights) {
    return glm::dvec3(scene.positions[corners.x]) * weights.x +
           glm::dvec3(scene.positions[corners.y]) * weights.y +
           glm::dvec3(scene.positions[corners.z]) * weights.z;
}

// Returns how far a point of a triangle shifts in the picture. Where one of its places is not in front of the
// camera, it has no shift.
glm::vec2 shiftOf(const Scene& scene, const Camera& camera, const NextFrame& next, const glm::uvec3& corners,
                  const glm::dvec3& weights) {
    const auto from = placeOf(camera, pointAt(scene, corners, weights));
    const auto to = placeOf(next.camera, pointAt(*next.scene, corners, weights));
    if (!from || !to) {
        return glm::vec2(0.0f);
    }
    glm::dvec2 shift = *to - *from;
    if (camera.projection == kProjectionPanorama) { // whose left edge is its right edge
        const double width = camera.width;
        shift.x -= width * std::round(shift.x / width);
    }
    return {shift.x, -shift.y};
}

SeenPoint seenPoint(const PreparedScene& prepared, const Camera& camera, const NextFrame* const next,
                    const CameraRay& view, const uint triangleId) {
    const Scene& scene = *prepared.scene;
    const glm::uvec3 corners = scene.triangles[triangleId];
    const TriangleRecord triangle{scene.positions[corners.x], triangleId, scene.positions[corners.y], 0,
                                  scene.positions[corners.z], 0};
    const Ray ray = makeRay(prepared.structure->lattice, view.origin, 0.0f, view.dir, kFarthest);
    const glm::vec3 weights = cornerWeights(ray, triangle.v0, triangle.v1, triangle.v2);
    SeenPoint seen;
    seen.position = makeSurfacePoint(triangle, weights).position;
    seen.uv = scene.texCoords[corners.x] * weights.x + scene.texCoords[corners.y] * weights.y +
              scene.texCoords[corners.z] * weights.z;
    seen.instance = scene.triangleMesh[triangleId];
    seen.mesh = scene.meshes[seen.instance].mesh;
    seen.material = scene.triangleMaterial[triangleId];
    if (next != nullptr) {
        seen.motion = shiftOf(scene, camera, *next, corners, weights);
    }
    return seen;
}

} // namespace

void checkNextFrame(const Scene& scene, const Scene& later) {
    const bool isSame = scene.triangles.size() == later.triangles.size() &&
                        scene.positions.size() == later.positions.size() &&
                        std::ranges::equal(scene.triangles, later.triangles);
    if (!isSame) {
        throw Error(ErrorKind::inputRefused,
                    "the scene has other triangles a frame later, so that points have no motion", {"aov"});
    }
}

std::vector<SeenPoint> seenPoints(const PreparedScene& scene, const Camera& camera, const PixelRect& area,
                                  const PathSettings* const path, const std::span<const FilmPixel> pixels,
                                  const NextFrame* const next) {
    static_assert(kNoMaterial == kNoId);
    std::vector<SeenPoint> seen(pixels.size());
    const auto seeRow = [&](const uint y) {
        for (uint x = 0; x < area.width(); ++x) {
            const std::size_t pixel = std::size_t{y} * area.width() + x;
            const uint triangleId = pixels[pixel].seen.triangleId;
            if (triangleId != kNoTriangle) {
                seen[pixel] = seenPoint(scene, camera, next,
                                        firstRay(camera, path, area.left + x, area.top + y), triangleId);
            }
        }
    };
    forEachPiece(area.height(), seeRow, {});
    return seen;
}

} // namespace metamarch::render
