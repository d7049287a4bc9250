// SPDX-License-Identifier: MIT
#include "metamarch/viewer/view_camera.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace metamarch::viewer {
namespace {

// The least angle, in radians, between the view and `up` or its opposite. At the pole the picture would flip.
constexpr float kLeastPolarAngle = 0.01f;

// The least distance between eye and target, as a fraction of their coordinates. Nearer, they would be one
// point in single precision.
constexpr float kLeastDistance = 1e-6f;

double toDegrees(const float radians) { return static_cast<double>(radians) * 180.0 / std::numbers::pi; }

glm::vec3 turned(const glm::vec3& v, const glm::vec3& axis, const float angle) {
    return glm::angleAxis(angle, axis) * v;
}

// Turns `v` by `around` around `up` and then by `towards` towards `up`, down to kLeastPolarAngle.
glm::vec3 turnedAbout(const glm::vec3& v, const glm::vec3& up, const float around, const float towards) {
    const glm::vec3 pole = glm::normalize(up);
    const glm::vec3 spun = turned(v, pole, around);
    const float polar = std::acos(std::clamp(glm::dot(glm::normalize(spun), pole), -1.0f, 1.0f));
    const float wanted =
        std::clamp(polar - towards, kLeastPolarAngle, std::numbers::pi_v<float> - kLeastPolarAngle);
    const glm::vec3 side = glm::cross(spun, pole);
    if (glm::dot(side, side) == 0.0f) {
        return spun;
    }
    return turned(spun, glm::normalize(side), polar - wanted);
}

// Returns the world's up if the camera is not tilted sideways, otherwise the camera's own.
glm::vec3 freeUp(const Axes& axes) {
    constexpr float kUpright = 1e-4f;
    const glm::vec3 worldUp(0.0f, 1.0f, 0.0f);
    const bool isUpright = std::abs(glm::dot(axes.right, worldUp)) < kUpright && axes.up.y > kUpright;
    return isUpright ? worldUp : axes.up;
}

void letGo(ViewCamera& camera) {
    if (camera.fileCamera) {
        camera.up = freeUp(axesOf(camera));
        camera.fileCamera.reset();
    }
}

// Returns true if the user has changed the field of view of a camera of the file.
bool hasOwnFov(const ViewCamera& camera, const Scene& scene) {
    return camera.verticalFov != toDegrees(scene.cameras[*camera.fileCamera].verticalFov);
}

bool isEmpty(const Bounds& bounds) { return bounds.lo.x > bounds.hi.x; }

glm::vec3 middleOf(const Bounds& bounds) {
    return isEmpty(bounds) ? glm::vec3(0.0f) : 0.5f * bounds.lo + 0.5f * bounds.hi;
}

std::string pointText(const glm::vec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

} // namespace

Axes axesOf(const ViewCamera& camera) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    return {right, glm::cross(right, forward), forward};
}

ViewCamera ofFile(const Scene& scene, const std::size_t index, const float distance) {
    const SceneCamera& source = scene.cameras[index];
    ViewCamera camera;
    camera.fileCamera = index;
    camera.eye = source.eye;
    camera.target = source.eye + source.forward * distance;
    camera.up = source.up;
    camera.verticalFov = toDegrees(source.verticalFov);
    if (source.projection == SceneCamera::Projection::orthographic) {
        camera.verticalExtent = source.verticalExtent;
    }
    return camera;
}

ViewCamera followed(const ViewCamera& camera, const Scene& before, const Scene& now, const float distance) {
    if (!camera.fileCamera) {
        return camera;
    }
    ViewCamera moved = camera;
    if (*camera.fileCamera >= now.cameras.size()) {
        letGo(moved);
        return moved;
    }
    const ViewCamera fresh = ofFile(now, *camera.fileCamera, distance);
    moved.eye = fresh.eye;
    moved.target = fresh.target;
    moved.up = fresh.up;
    moved.verticalExtent = fresh.verticalExtent;
    if (!hasOwnFov(camera, before)) {
        moved.verticalFov = fresh.verticalFov;
    }
    return moved;
}

ViewCamera framing(const Bounds& bounds, const float aspect, const double verticalFov) {
    const auto fov = static_cast<float>(verticalFov * std::numbers::pi / 180.0);
    const SceneCamera framed = frameBounds(bounds, fov, aspect);
    ViewCamera camera;
    camera.eye = framed.eye;
    camera.target = middleOf(bounds);
    camera.verticalFov = verticalFov;
    return camera;
}

ViewCamera framing(const Bounds& bounds, const float aspect, const ViewCamera& from) {
    const auto fov = static_cast<float>(from.verticalFov * std::numbers::pi / 180.0);
    const Axes axes = axesOf(from);
    const SceneCamera framed = frameBounds(bounds, fov, aspect, -axes.forward, axes.up);
    ViewCamera camera = from;
    letGo(camera);
    camera.eye = framed.eye;
    camera.target = middleOf(bounds);
    if (camera.verticalExtent) {
        const float diagonal = glm::length(bounds.hi - bounds.lo);
        const bool hasSize = !isEmpty(bounds) && diagonal > 0.0f;
        camera.verticalExtent = (hasSize ? diagonal : 1.0f) / std::min(aspect, 1.0f);
    }
    return camera;
}

ViewCamera axisView(const Bounds& bounds, const float aspect, const glm::vec3& towards,
                    const ViewCamera& from) {
    ViewCamera camera = from;
    letGo(camera);
    camera.target = middleOf(bounds);
    camera.eye = camera.target + towards;
    // From above the picture's top is away from the viewer who stands in front, as in Blender.
    camera.up = std::abs(towards.y) < 0.5f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, -towards.y);
    return framing(bounds, aspect, camera);
}

SceneCamera sceneCameraOf(const ViewCamera& camera, const Scene& scene) {
    SceneCamera made =
        camera.fileCamera ? scene.cameras[*camera.fileCamera] : lookAt(camera.eye, camera.target, camera.up);
    if (!camera.fileCamera || hasOwnFov(camera, scene)) {
        made.verticalFov = static_cast<float>(camera.verticalFov * std::numbers::pi / 180.0);
    }
    if (!camera.fileCamera && camera.verticalExtent) {
        made.projection = SceneCamera::Projection::orthographic;
        made.verticalExtent = *camera.verticalExtent;
    }
    return made;
}

CameraOptions lensOf(const ViewCamera& camera) {
    CameraOptions lens;
    lens.isPanorama = camera.isPanorama;
    if (!camera.isPanorama && camera.apertureRadius > 0.0f) {
        lens.apertureRadius = camera.apertureRadius;
        lens.focusDistance = camera.focusDistance.value_or(lens.focusDistance);
    }
    return lens;
}

std::string optionsText(const ViewCamera& camera, const Scene& scene) {
    std::string text;
    if (camera.fileCamera) {
        text = fmt::format("--camera {}", *camera.fileCamera);
    } else {
        text = fmt::format("--eye {} --target {} --up {}", pointText(camera.eye), pointText(camera.target),
                           pointText(camera.up));
    }
    if (camera.isPanorama) {
        return text + " --panorama";
    }
    if (camera.verticalExtent && !camera.fileCamera) {
        text += fmt::format(" --orthographic {}", *camera.verticalExtent);
    } else if (!camera.verticalExtent && (!camera.fileCamera || hasOwnFov(camera, scene))) {
        text += fmt::format(" --vfov {}", camera.verticalFov);
    }
    if (camera.apertureRadius > 0.0f) {
        text += fmt::format(" --aperture {}", camera.apertureRadius);
        if (camera.focusDistance) {
            text += fmt::format(" --focus-distance {}", *camera.focusDistance);
        }
    }
    return text;
}

void orbit(ViewCamera& camera, const float right, const float down) {
    pan(camera, camera.aside, 0.0f);
    camera.eye = camera.target + turnedAbout(camera.eye - camera.target, camera.up, -right, down);
    pan(camera, -camera.aside, 0.0f);
}

void look(ViewCamera& camera, const float right, const float down) {
    letGo(camera);
    camera.target = camera.eye + turnedAbout(camera.target - camera.eye, camera.up, -right, -down);
}

void pan(ViewCamera& camera, const float right, const float up) {
    letGo(camera);
    const Axes axes = axesOf(camera);
    const auto halfAngle = static_cast<float>(camera.verticalFov * std::numbers::pi / 360.0);
    const float height =
        camera.verticalExtent.value_or(2.0f * std::tan(halfAngle) * glm::length(camera.target - camera.eye));
    const glm::vec3 way = (axes.right * right + axes.up * up) * height;
    camera.eye += way;
    camera.target += way;
}

void zoom(ViewCamera& camera, const float factor, const glm::vec3& point) {
    letGo(camera);
    const glm::vec3 eye = point + (camera.eye - point) * factor;
    const glm::vec3 target = point + (camera.target - point) * factor;
    const float size = std::max(glm::length(eye), glm::length(target));
    if (glm::length(target - eye) < kLeastDistance * size && factor < 1.0f) {
        return;
    }
    camera.eye = eye;
    camera.target = target;
    if (camera.verticalExtent) {
        *camera.verticalExtent *= factor;
    }
}

void fly(ViewCamera& camera, const float right, const float up, const float forward) {
    letGo(camera);
    const Axes axes = axesOf(camera);
    const glm::vec3 way = axes.right * right + axes.up * up + axes.forward * forward;
    camera.eye += way;
    camera.target += way;
}

} // namespace metamarch::viewer
