// SPDX-License-Identifier: MIT
#include "metamarch/bench/views.h"

#include <algorithm>
#include <cmath>

namespace metamarch::bench {
namespace {

struct Place {
    glm::vec3 center{0.0f};
    float diagonal = 1.0f;
};

Place placeOf(const Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    if (!(bounds.lo.x <= bounds.hi.x)) {
        return {};
    }
    const float diagonal = glm::length(bounds.hi - bounds.lo);
    return {0.5f * bounds.lo + 0.5f * bounds.hi, diagonal > 0.0f ? diagonal : 1.0f};
}

SceneCamera cameraFrom(const Place& place, const AxisView& view, const float distance) {
    // Find the direction at the world's origin: for a small scene far away it would be rounded.
    SceneCamera camera = lookAt(view.from, glm::vec3(0.0f), view.up);
    camera.name = view.name;
    camera.eye = place.center + view.from * distance;
    return camera;
}

} // namespace

SceneCamera axisCamera(const Scene& scene, const AxisView& view, const float diagonals) {
    const Place place = placeOf(scene);
    return cameraFrom(place, view, diagonals * place.diagonal);
}

SceneCamera fillingCamera(const Scene& scene, const AxisView& view, const float aspect) {
    const Place place = placeOf(scene);
    const glm::vec3 right = glm::cross(view.up, view.from);
    const float slopeUp = std::tan(0.5f * kDefaultVerticalFov);
    const float slopeRight = slopeUp * aspect;
    float distance = 0.0f;
    for (const glm::uvec3& triangle : scene.triangles) {
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 p = scene.positions[triangle[i]] - place.center;
            distance = std::max({distance, glm::dot(p, view.from) + std::abs(glm::dot(p, view.up)) / slopeUp,
                                 glm::dot(p, view.from) + std::abs(glm::dot(p, right)) / slopeRight});
        }
    }
    return cameraFrom(place, view, distance > 0.0f ? distance : place.diagonal);
}

} // namespace metamarch::bench
