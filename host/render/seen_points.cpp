// SPDX-License-Identifier: MIT
#include "metamarch/render/seen_points.h"

#include "metamarch/reference/pieces.h"
#include "metamarch/shared/hit_point.h"
#include "metamarch/shared/path.h"

namespace metamarch::render {
namespace {

CameraRay firstRay(const Camera& camera, const PathSettings* const path, const uint x, const uint y) {
    if (path == nullptr) {
        return cameraRay(camera, x, y);
    }
    const Path first = cameraPath(camera, *path, x, y, makePixelSample(x, y, 0, path->seed));
    return {first.origin, first.dir};
}

SeenPoint seenPoint(const PreparedScene& prepared, const CameraRay& view, const uint triangleId) {
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
    return seen;
}

} // namespace

std::vector<SeenPoint> seenPoints(const PreparedScene& scene, const Camera& camera, const PixelRect& area,
                                  const PathSettings* const path, const std::span<const FilmPixel> pixels) {
    static_assert(kNoMaterial == kNoId);
    std::vector<SeenPoint> seen(pixels.size());
    const auto seeRow = [&](const uint y) {
        for (uint x = 0; x < area.width(); ++x) {
            const std::size_t pixel = std::size_t{y} * area.width() + x;
            const uint triangleId = pixels[pixel].seen.triangleId;
            if (triangleId != kNoTriangle) {
                seen[pixel] =
                    seenPoint(scene, firstRay(camera, path, area.left + x, area.top + y), triangleId);
            }
        }
    };
    forEachPiece(area.height(), seeRow, {});
    return seen;
}

} // namespace metamarch::render
