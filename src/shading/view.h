// From a scene's cameras, or none, to the camera that shaders and judges trace.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shared/camera.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace metamarch {

// Rounded from 45 degrees; what a picture without a camera of its own is taken with.
inline constexpr float kDefaultVerticalFov = 0.785398163f;

// The camera `selection` names: its index in the file or its name. Throws Error(invalidArgument) listing the
// cameras.
const SceneCamera& selectCamera(const Scene& scene, const std::string& selection);

// Looks at `target` from `eye`. Throws Error(invalidArgument) where the two are one point or `up` is along
// the view.
SceneCamera lookAt(glm::vec3 eye, glm::vec3 target, glm::vec3 up);

// From where an unframed scene is seen: towards +Z, the front in glTF, turned to the right and up.
inline constexpr glm::vec3 kFramingDirection{0.45f, 0.35f, 1.0f};

// Sees the whole of `bounds` in a picture of `aspect` (width / height), looking from the side of `from`, a
// direction. An empty box is looked at as if it were the unit cube. Throws as lookAt.
SceneCamera frameBounds(const Bounds& bounds, float verticalFov, float aspect,
                        glm::vec3 from = kFramingDirection, glm::vec3 up = {0.0f, 1.0f, 0.0f});

// What a picture asks of its camera beyond the scene's. The default is a pinhole whose samples fill their
// pixel evenly.
struct CameraOptions {
    std::uint32_t pixelFilter = kFilterBox;
    float apertureRadius = 0.0f; // of a thin lens, in world units
    // From the eye along the view to the plane in focus, in world units; infinite: what is far away.
    float focusDistance = std::numeric_limits<float>::infinity();
    bool isPanorama = false; // all directions around the eye, `forward` in the centre of the picture
};

// From where and through which lens a user wants to see a scene.
struct ViewChoice {
    std::string camera; // a camera of the scene, by name or index; empty: `eye`, or else the first
    // World space. `eye` and `target` are there together; without `up`, +y is up.
    std::optional<glm::vec3> eye;
    std::optional<glm::vec3> target;
    std::optional<glm::vec3> up;
    std::optional<double> verticalFov;       // degrees; takes the place of the camera's own
    std::optional<float> orthographicHeight; // world units; parallel rays from `eye`
    CameraOptions lens;
};

// The camera that `choice` asks for, else the scene's first, else one that sees the whole scene in a picture
// of `aspect` (width / height). Throws Error(invalidArgument) for a camera that does not exist and as lookAt.
SceneCamera chooseCamera(const Scene& scene, const ViewChoice& choice, float aspect);

// `width` and `height` in pixels. Throws Error(invalidArgument) for a radius or distance out of range, and
// for a panorama with a lens.
Camera makeCamera(const SceneCamera& camera, std::uint32_t width, std::uint32_t height,
                  const CameraOptions& options = {});

} // namespace metamarch
