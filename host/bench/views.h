// SPDX-License-Identifier: MIT
// The benchmarks' cameras: four views along the axes.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/view.h"

#include <array>
#include <string>
#include <vector>

namespace metamarch::bench {

// The direction from the scene to the camera, and the direction that is up in the picture.
struct AxisView {
    const char* name;
    glm::vec3 from;
    glm::vec3 up;
};

inline constexpr std::array<AxisView, 4> kAxisViews{{{"front", {0, 0, 1}, {0, 1, 0}},
                                                     {"top", {0, 1, 0}, {0, 0, -1}},
                                                     {"left", {-1, 0, 0}, {0, 1, 0}},
                                                     {"right", {1, 0, 0}, {0, 1, 0}}}};

// Returns a camera that looks at the centre of the scene's box from `diagonals` times the box's diagonal; its
// vertical field of view is kDefaultVerticalFov. An empty scene is treated like a single point.
SceneCamera axisCamera(const Scene& scene, const AxisView& view, float diagonals);

// The same view, from as close as possible while a picture with `aspect` = width / height shows every vertex:
// the model fills it.
SceneCamera fillingCamera(const Scene& scene, const AxisView& view, float aspect);

} // namespace metamarch::bench
