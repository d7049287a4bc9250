// SPDX-License-Identifier: MIT
#include "metamarch/viewer/pick.h"

namespace metamarch::viewer {

Ray rayThrough(const LoadedScene& scene, const Camera& camera, const glm::vec2 place) {
    const CameraRay view = cameraRayThrough(camera, place, vec2(0.0f));
    return makeRay(scene.shown.structure->lattice, view.origin, 0.0f, view.dir, kFarthest);
}

std::optional<Pick> pick(const LoadedScene& scene, const Camera& camera, const glm::vec2 place) {
    const CameraRay view = cameraRayThrough(camera, place, vec2(0.0f));
    const Ray ray = rayThrough(scene, camera, place);
    const TraceResult found = traceKdStack(*scene.shown.structure, ray, HitQuery::closest);
    if (found.hit.triangleId == kNoTriangle) {
        return std::nullopt;
    }
    const Scene& shown = *scene.shown.scene;
    const glm::uvec3 corners = shown.triangles[found.hit.triangleId];
    Pick picked{};
    picked.triangleId = found.hit.triangleId;
    picked.mesh = shown.triangleMesh[picked.triangleId];
    picked.material = shown.triangleMaterial[picked.triangleId];
    for (int i = 0; i < 3; ++i) {
        picked.corners[i] = shown.positions[corners[i]];
    }
    picked.distance = ray.shift + found.hit.t;
    picked.position = view.origin + view.dir * picked.distance;
    picked.depth = camera.projection == kProjectionPanorama
                       ? picked.distance
                       : picked.distance * glm::dot(view.dir, camera.forward);
    return picked;
}

FrozenMarch marchThrough(const LoadedScene& scene, const Camera& camera, const glm::vec2 place) {
    const CameraRay view = cameraRayThrough(camera, place, vec2(0.0f));
    const Ray ray = rayThrough(scene, camera, place);
    return {view.origin, view.dir, logMarch(*scene.shown.structure, ray),
            logWalk(*scene.shown.structure, ray)};
}

} // namespace metamarch::viewer
