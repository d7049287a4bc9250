// SPDX-License-Identifier: MIT
#include "metamarch/shading/view.h"

#include "metamarch/error/error.h"
#include "metamarch/scene/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace metamarch {
namespace {

// Returns half the height of a perspective camera's picture at distance 1.
float halfHeight(const double verticalFov) { return static_cast<float>(std::tan(0.5 * verticalFov)); }

void checkLens(const CameraOptions& options) {
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    if (!(options.apertureRadius >= 0.0f && std::isfinite(options.apertureRadius))) {
        refuse(fmt::format("an aperture's radius of {}: give world units, 0 for a pinhole",
                           options.apertureRadius));
    }
    // The inverse must be finite.
    if (!(options.focusDistance >= std::numeric_limits<float>::min())) {
        refuse(fmt::format("a focus distance of {}: give world units above 0", options.focusDistance));
    }
    if (options.isPanorama && options.apertureRadius > 0.0f) {
        refuse("a panorama is taken without a lens: leave out the aperture");
    }
}

} // namespace

const SceneCamera& selectCamera(const Scene& scene, const std::string& selection) {
    if (scene.cameras.empty()) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("camera {}: the scene has no camera; give eye and target", selection),
                    {"camera", "eye", "target"});
    }
    std::vector<std::string> names;
    names.reserve(scene.cameras.size());
    for (const SceneCamera& camera : scene.cameras) {
        names.push_back(camera.name);
    }
    return scene.cameras[chooseIndex("camera", names, selection, "scene")];
}

SceneCamera lookAt(const glm::vec3 eye, const glm::vec3 target, const glm::vec3 up) {
    // Double precision is needed because the points may be far away and the vectors tiny or huge.
    const glm::dvec3 along = glm::dvec3(target) - glm::dvec3(eye);
    const glm::dvec3 right = glm::cross(along, glm::dvec3(up));
    if (glm::length(along) == 0.0) {
        throw Error(ErrorKind::invalidArgument, "eye and target are the same point", {"eye", "target"});
    }
    if (glm::length(right) <= 1e-6 * glm::length(along) * glm::length(glm::dvec3(up))) {
        throw Error(ErrorKind::invalidArgument, "up is zero or along the view; choose another", {"up"});
    }
    SceneCamera camera;
    camera.name = "eye";
    camera.eye = eye;
    camera.forward = glm::vec3(glm::normalize(along));
    camera.up = glm::vec3(glm::normalize(glm::cross(right, along)));
    camera.verticalFov = kDefaultVerticalFov;
    return camera;
}

SceneCamera frameBounds(const Bounds& bounds, const float verticalFov, const float aspect,
                        const glm::vec3 from, const glm::vec3 upwards) {
    const bool empty = !(bounds.lo.x <= bounds.hi.x);
    const glm::vec3 lo = empty ? glm::vec3(-0.5f) : bounds.lo;
    const glm::vec3 hi = empty ? glm::vec3(0.5f) : bounds.hi;
    const glm::vec3 center = 0.5f * lo + 0.5f * hi;
    const glm::vec3 size = hi - lo;
    // Find the direction at the world's origin; for a small box far away it would be rounded.
    SceneCamera camera = lookAt(from, glm::vec3(0.0f), upwards);
    camera.name = "framed";
    camera.verticalFov = verticalFov;

    // Find the distance at which every corner of the box is in the picture.
    const glm::vec3 right = glm::cross(camera.forward, camera.up);
    const float slopeUp = halfHeight(verticalFov);
    const float slopeRight = slopeUp * aspect;
    float distance = 0.0f;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::vec3 corner =
            0.5f * size * glm::vec3(i & 1u ? 1.0f : -1.0f, i & 2u ? 1.0f : -1.0f, i & 4u ? 1.0f : -1.0f);
        const float nearer = -glm::dot(corner, camera.forward);
        distance = std::max({distance, nearer + std::abs(glm::dot(corner, camera.up)) / slopeUp,
                             nearer + std::abs(glm::dot(corner, right)) / slopeRight});
    }
    constexpr float kBorder = 1.05f;
    camera.eye = center - camera.forward * (distance > 0.0f ? distance * kBorder : 1.0f);
    return camera;
}

SceneCamera chooseCamera(const Scene& scene, const ViewChoice& choice, const float aspect) {
    const auto fov = choice.verticalFov
                         ? std::optional(static_cast<float>(*choice.verticalFov * std::numbers::pi / 180.0))
                         : std::nullopt;
    SceneCamera chosen;
    if (choice.eye && choice.target) {
        chosen = lookAt(*choice.eye, *choice.target, choice.up.value_or(glm::vec3(0.0f, 1.0f, 0.0f)));
        if (choice.orthographicHeight) {
            chosen.projection = SceneCamera::Projection::orthographic;
            chosen.verticalExtent = *choice.orthographicHeight;
        }
    } else if (!choice.camera.empty() || !scene.cameras.empty()) {
        chosen = selectCamera(scene, choice.camera.empty() ? "0" : choice.camera);
    } else {
        return frameBounds(boundsOf(scene), fov.value_or(kDefaultVerticalFov), aspect);
    }
    chosen.verticalFov = fov.value_or(chosen.verticalFov);
    return chosen;
}

Camera makeCamera(const SceneCamera& camera, const std::uint32_t width, const std::uint32_t height,
                  const CameraOptions& options) {
    checkLens(options);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const glm::vec3 right = glm::cross(camera.forward, camera.up);
    Camera result{};
    result.eye = camera.eye;
    result.forward = camera.forward;
    result.width = width;
    result.height = height;
    result.pixelFilter = options.pixelFilter;
    if (options.isPanorama) {
        result.projection = kProjectionPanorama;
        result.dirRight = right;
        result.dirDown = -camera.up;
        return result;
    }
    const bool perspective = camera.projection == SceneCamera::Projection::perspective;
    const float half = perspective ? halfHeight(camera.verticalFov) : 0.5f * camera.verticalExtent;
    (perspective ? result.dirRight : result.eyeRight) = right * (half * aspect);
    (perspective ? result.dirDown : result.eyeDown) = camera.up * -half;
    result.lensRight = right * options.apertureRadius;
    result.lensDown = camera.up * -options.apertureRadius;
    result.inverseFocus = 1.0f / options.focusDistance;
    return result;
}

std::optional<glm::dvec2> placeOf(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec3 offset = point - glm::dvec3(camera.eye);
    const glm::dvec2 size(camera.width, camera.height);
    const auto along = [&](const glm::vec3& axis) {
        return glm::dot(offset, glm::dvec3(axis)) / glm::dot(glm::dvec3(axis), glm::dvec3(axis));
    };
    if (camera.projection == kProjectionPanorama) {
        const double length = glm::length(offset);
        if (!(length > 0.0)) {
            return std::nullopt;
        }
        const double around = std::atan2(along(camera.dirRight), along(camera.forward));
        const double below = std::acos(glm::clamp(-along(camera.dirDown) / length, -1.0, 1.0));
        return glm::dvec2(0.5 + 0.5 * around / std::numbers::pi, below / std::numbers::pi) * size;
    }
    const bool isParallel = camera.dirRight == glm::vec3(0.0f);
    const double depth = isParallel ? 1.0 : along(camera.forward);
    if (!(depth > 0.0)) {
        return std::nullopt;
    }
    const glm::dvec2 fromMiddle(along(isParallel ? camera.eyeRight : camera.dirRight),
                                along(isParallel ? camera.eyeDown : camera.dirDown));
    return (fromMiddle / depth + 1.0) * 0.5 * size;
}

} // namespace metamarch
