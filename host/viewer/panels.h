// SPDX-License-Identifier: MIT
// Draws the panels over the picture.
#pragma once
#include "metamarch/viewer/viewer_state.h"

namespace metamarch::viewer {

// Call it within a frame of Dear ImGui.
void drawPanels(ViewerState& state);

} // namespace metamarch::viewer
