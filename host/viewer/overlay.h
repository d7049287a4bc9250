// SPDX-License-Identifier: MIT
// Draws lines and labels over the picture: the legend of a view, the split line, the picked triangle and the
// march of a ray.
#pragma once
#include "metamarch/viewer/viewer_state.h"

namespace metamarch::viewer {

// Call it within a frame of Dear ImGui, and only with a scene.
void drawOverlay(const ViewerState& state);

} // namespace metamarch::viewer
