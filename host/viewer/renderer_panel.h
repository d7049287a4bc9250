// SPDX-License-Identifier: MIT
// The panel's section of what is rendered, and how.
#pragma once
#include "metamarch/viewer/viewer_state.h"

namespace metamarch::viewer {

// Call it within a window of Dear ImGui.
void drawRenderer(ViewerState& state);

} // namespace metamarch::viewer
