// SPDX-License-Identifier: MIT
// Where the viewer looks from, and how hands move it. No window in here.
#pragma once
#include "metamarch/shading/view.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace metamarch::viewer {

// One of the file's cameras as it is, or eye, target and up of the user's own.
struct ViewCamera {
    std::optional<std::size_t> fileCamera; // of Scene::cameras; the first hand that moves it lets go of it
    glm::vec3 eye{0.0f, 0.0f, 1.0f};
    glm::vec3 target{0.0f}; // what it turns around
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    double verticalFov = 45.0;           // degrees, of a perspective camera
    std::optional<float> verticalExtent; // of parallel rays: height of the picture in world units
    float apertureRadius = 0.0f;         // world units; 0: a pinhole
    std::optional<float> focusDistance;  // world units; none: far away
    bool isPanorama = false;

    bool operator==(const ViewCamera&) const = default;
};

// The file's camera `index`, with the target at `distance` along its view.
ViewCamera ofFile(const Scene& scene, std::size_t index, float distance);

// After `before` was read again as `now`: where it was one of the file's cameras it is that one as it is now,
// or stays where it is if that is gone. `distance` as above.
ViewCamera followed(const ViewCamera& camera, const Scene& before, const Scene& now, float distance);

// Sees the whole of `bounds`: from where the command line looks by default, or, with `from`, in that camera's
// direction.
ViewCamera framing(const Bounds& bounds, float aspect, double verticalFov);
ViewCamera framing(const Bounds& bounds, float aspect, const ViewCamera& from);

// What shaders and judges trace. `scene` has the file's cameras.
SceneCamera sceneCameraOf(const ViewCamera& camera, const Scene& scene);
CameraOptions lensOf(const ViewCamera& camera);

// The options of `metamarch render` that make this camera of `scene` again, to the bit.
std::string optionsText(const ViewCamera& camera, const Scene& scene);

// All of these let go of the file's camera. Angles in radians.

// Around the target; never over the poles of `up`.
void orbit(ViewCamera& camera, float right, float down);
// Turns the head.
void look(ViewCamera& camera, float right, float down);
// By parts of the picture's height at the target.
void pan(ViewCamera& camera, float right, float up);
// Towards the point where the factor is below 1, which stays where it is in the picture.
void zoom(ViewCamera& camera, float factor, const glm::vec3& point);
// Along the camera's own axes, in world units.
void fly(ViewCamera& camera, float right, float up, float forward);

// Right, up and forward, orthonormal.
struct Axes {
    glm::vec3 right;
    glm::vec3 up;
    glm::vec3 forward;
};
Axes axesOf(const ViewCamera& camera);

} // namespace metamarch::viewer
