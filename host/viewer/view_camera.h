// SPDX-License-Identifier: MIT
// The viewer's camera and how the user moves it. This file knows nothing about windows.
#pragma once
#include "metamarch/shading/view.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace metamarch::viewer {

// A camera of the scene's file, unchanged but for its lens, or a free camera with eye, target and up.
struct ViewCamera {
    std::optional<std::size_t> fileCamera; // index in Scene::cameras; none: a free camera
    glm::vec3 eye{0.0f, 0.0f, 1.0f};
    glm::vec3 target{0.0f};
    float aside = 0.0f; // orbit() turns around a point so far right of the target; the unit is that of pan()
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    double verticalFov = 45.0;           // degrees, for a perspective camera
    std::optional<float> verticalExtent; // parallel rays: height of the picture in world units
    float apertureRadius = 0.0f;         // world units; 0: a pinhole
    std::optional<float> focusDistance;  // world units; none: infinity
    bool isPanorama = false;

    bool operator==(const ViewCamera&) const = default;
};

// Returns the file's camera `index`, with its target at `distance` along its view axis.
ViewCamera ofFile(const Scene& scene, std::size_t index, float distance);

// Returns the camera to use after the file of `before` was read again as `now`. A free camera stays as it is.
// A camera of the file becomes the one that the file has now at the same index, or, if there is none, a free
// camera in the same place. `distance` is as for ofFile.
ViewCamera followed(const ViewCamera& camera, const Scene& before, const Scene& now, float distance);

// Returns a camera that sees the whole of `bounds`: from the default direction of the command line, or in the
// direction of `from`.
ViewCamera framing(const Bounds& bounds, float aspect, double verticalFov);
ViewCamera framing(const Bounds& bounds, float aspect, const ViewCamera& from);

// Returns a camera that sees the whole of `bounds` against `towards`, a unit vector from the scene to the
// eye.
ViewCamera axisView(const Bounds& bounds, float aspect, const glm::vec3& towards, const ViewCamera& from);

// Return the camera and the lens that shaders and judges trace. `scene` has the file's cameras.
SceneCamera sceneCameraOf(const ViewCamera& camera, const Scene& scene);
CameraOptions lensOf(const ViewCamera& camera);

// Returns the options with which `metamarch render` makes exactly this camera of `scene`.
std::string optionsText(const ViewCamera& camera, const Scene& scene);

// Each of the following makes the camera a free one. Angles are in radians.

// Turns eye and target around the point `aside` of the target, but never past the poles of `up`.
void orbit(ViewCamera& camera, float right, float down);
// Turns the target around the eye, but never past the poles of `up`.
void look(ViewCamera& camera, float right, float down);
// Moves eye and target sideways. The unit is the height of the picture at the target.
void pan(ViewCamera& camera, float right, float up);
// Multiplies the distance from `point` by `factor`. The point stays where it is in the picture.
void zoom(ViewCamera& camera, float factor, const glm::vec3& point);
// Moves eye and target along the camera's axes. The unit is that of the world.
void fly(ViewCamera& camera, float right, float up, float forward);

// The camera's axes; they are orthonormal.
struct Axes {
    glm::vec3 right;
    glm::vec3 up;
    glm::vec3 forward;
};
Axes axesOf(const ViewCamera& camera);

} // namespace metamarch::viewer
