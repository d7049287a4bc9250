// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/camera.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace metamarch {
namespace {

// Returns nothing for a vector that has no direction.
std::optional<glm::dvec3> direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    if (!std::isfinite(length) || length == 0.0) {
        return std::nullopt;
    }
    return v / length;
}

bool place(SceneCamera& camera, const glm::dmat4& toWorld) {
    const std::optional<glm::dvec3> forward = direction(-glm::dvec3(toWorld[2]));
    const std::optional<glm::dvec3> upward = direction(glm::dvec3(toWorld[1]));
    if (!forward || !upward) {
        return false;
    }
    // The axes of a sheared node are not orthonormal: keep the view direction and adjust up.
    const std::optional<glm::dvec3> up = direction(*upward - *forward * glm::dot(*forward, *upward));
    camera.eye = glm::vec3(toWorld[3]);
    if (!up || !std::isfinite(glm::length(glm::dvec3(camera.eye)))) {
        return false;
    }
    camera.forward = glm::vec3(*forward);
    camera.up = glm::vec3(*up);
    return true;
}

} // namespace

std::optional<SceneCamera> readCamera(const tinygltf::Camera& source, const glm::dmat4& toWorld,
                                      double scale) {
    SceneCamera camera;
    bool sound;
    if (source.type == "orthographic") {
        const double extent = 2.0 * std::abs(source.orthographic.ymag * scale);
        camera.projection = SceneCamera::Projection::orthographic;
        camera.verticalExtent = static_cast<float>(extent);
        sound = camera.verticalExtent > 0.0f && std::isfinite(camera.verticalExtent);
    } else {
        camera.verticalFov = static_cast<float>(source.perspective.yfov);
        sound = camera.verticalFov > 0.0f && source.perspective.yfov < glm::pi<double>();
    }
    return sound && place(camera, toWorld) ? std::optional(camera) : std::nullopt;
}

} // namespace metamarch
