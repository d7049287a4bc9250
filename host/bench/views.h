// The cameras of the benchmarks: four views along the axes.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/view.h"

#include <array>
#include <string>
#include <vector>

namespace metamarch::bench {

// Where an axis view is taken from, seen from the scene, and what is up in its picture.
struct AxisView {
    const char* name;
    glm::vec3 from;
    glm::vec3 up;
};

inline constexpr std::array<AxisView, 4> kAxisViews{{{"front", {0, 0, 1}, {0, 1, 0}},
                                                     {"top", {0, 1, 0}, {0, 0, -1}},
                                                     {"left", {-1, 0, 0}, {0, 1, 0}},
                                                     {"right", {1, 0, 0}, {0, 1, 0}}}};

// Looks at the centre of the scene's box from `diagonals` of its diagonal away; the vertical field of view is
// kDefaultVerticalFov. An empty scene is looked at as if it were one point.
SceneCamera axisCamera(const Scene& scene, const AxisView& view, float diagonals);

// The same from as near as shows every vertex in a picture of `aspect` (width / height): the model fills it.
SceneCamera fillingCamera(const Scene& scene, const AxisView& view, float aspect);

} // namespace metamarch::bench
