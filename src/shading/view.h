// SPDX-License-Identifier: MIT
// Turns a scene's camera, or a default, into the camera that shaders and the reference trace.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shared/camera.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace metamarch {

// 45 degrees in radians, rounded; used for pictures without a camera of their own.
inline constexpr float kDefaultVerticalFov = 0.785398163f;

// Returns the camera that `selection` names by its index in the file or its name. Throws
// Error(invalidArgument), listing the cameras.
const SceneCamera& selectCamera(const Scene& scene, const std::string& selection);

// Returns a camera at `eye` that looks at `target`. Throws Error(invalidArgument) if the two coincide or `up`
// is parallel to the view.
SceneCamera lookAt(glm::vec3 eye, glm::vec3 target, glm::vec3 up);

// The direction from a scene to its default camera: from +Z, the front in glTF, moved to the right and up.
inline constexpr glm::vec3 kFramingDirection{0.45f, 0.35f, 1.0f};

// Returns a camera that sees all of `bounds` in a picture with `aspect` = width / height, from the direction
// `from`. An empty box is treated like the unit cube. Throws like lookAt.
SceneCamera frameBounds(const Bounds& bounds, float verticalFov, float aspect,
                        glm::vec3 from = kFramingDirection, glm::vec3 up = {0.0f, 1.0f, 0.0f});

// Properties of a picture's camera that a SceneCamera does not have. The default is a pinhole whose samples
// are spread uniformly over the pixel.
struct CameraOptions {
    std::uint32_t pixelFilter = kFilterBox;
    float apertureRadius = 0.0f; // radius of the thin lens, world units
    // The distance from the eye to the plane in focus, along the view axis, in world units; may be infinite.
    float focusDistance = std::numeric_limits<float>::infinity();
    // Shows all directions around the eye, with `forward` in the centre of the picture.
    bool isPanorama = false;
};

// The user's choice of viewpoint and lens.
struct ViewChoice {
    std::string camera; // name or index of a camera of the scene; empty: use `eye`, or the first camera
    // Points and direction in world space. `eye` and `target` must be given together; without `up`, +y is up.
    std::optional<glm::vec3> eye;
    std::optional<glm::vec3> target;
    std::optional<glm::vec3> up;
    std::optional<double> verticalFov;       // degrees; replaces that of the camera
    std::optional<float> orthographicHeight; // world units; makes the rays from `eye` parallel
    CameraOptions lens;
};

// Returns the camera of `choice`; without one, the first camera of the scene; without that, one that sees the
// whole scene in a picture with `aspect` = width / height. Throws Error(invalidArgument) for a camera that
// does not exist, and what lookAt throws.
SceneCamera chooseCamera(const Scene& scene, const ViewChoice& choice, float aspect);

// `width` and `height` are in pixels. Throws Error(invalidArgument) if a radius or distance is out of range,
// and for a panorama with a lens.
Camera makeCamera(const SceneCamera& camera, std::uint32_t width, std::uint32_t height,
                  const CameraOptions& options = {});

// Returns where a picture shows a point of the world, in pixels from its upper left corner, as a pinhole in
// the middle of the lens sees it. Returns nothing for a point that is not in front of the camera, or at the
// eye of a panorama.
std::optional<glm::dvec2> placeOf(const Camera& camera, const glm::dvec3& point);

} // namespace metamarch
