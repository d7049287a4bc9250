// SPDX-License-Identifier: MIT
#include "metamarch/reference/primary.h"

#include "metamarch/reference/triangle_records.h"

namespace metamarch {
namespace {

FilmPixel renderPixel(const AccelerationStructure& structure,
                      const std::span<const ShadingMaterial> materials,
                      const std::span<const std::uint32_t> materialOfTriangle, const Camera& camera,
                      const uint x, const uint y) {
    const CameraRay view = cameraRay(camera, x, y);
    const Ray ray = makeRay(structure.lattice, view.origin, 0.0f, view.dir, kFarthest);
    const TraceResult trace = traceKdStack(structure, ray, HitQuery::closest);
    FilmPixel pixel = missPrimary();
    if (trace.hit.triangleId != kNoTriangle) {
        pixel = shadePrimary(camera, view, ray, trace.hit, structure.triangles[trace.recordIndex],
                             materials[materialOfTriangle[trace.hit.triangleId]]);
    }
    pixel.rays = 1;
    pixel.steps = static_cast<float>(trace.steps);
    pixel.tests = static_cast<float>(trace.tests);
    return pixel;
}

} // namespace

std::vector<FilmPixel> renderPrimaryByJudge(const AccelerationStructure& structure,
                                            const std::span<const ShadingMaterial> materials,
                                            const std::span<const std::uint32_t> materialOfTriangle,
                                            const Camera& camera, const OnProgress& onProgress) {
    std::vector<FilmPixel> pixels(std::size_t{camera.width} * camera.height, emptyPixel());
    const auto renderRow = [&](const uint y) {
        for (uint x = 0; x < camera.width; ++x) {
            pixels[std::size_t{y} * camera.width + x] =
                renderPixel(structure, materials, materialOfTriangle, camera, x, y);
        }
    };
    forEachPiece(camera.height, renderRow, onProgress);
    return pixels;
}

} // namespace metamarch
