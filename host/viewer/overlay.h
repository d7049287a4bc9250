// SPDX-License-Identifier: MIT
// Lines and labels drawn over the picture: the legend of a view, the line between two sides, what is picked,
// the march of a ray.
#pragma once
#include "metamarch/viewer/viewer_state.h"

namespace metamarch::viewer {

// Within a frame of Dear ImGui. Only with a scene.
void drawOverlay(const ViewerState& state);

} // namespace metamarch::viewer
