// SPDX-License-Identifier: MIT
// The panels over the picture.
#pragma once
#include "metamarch/viewer/viewer_state.h"

namespace metamarch::viewer {

// Within a frame of Dear ImGui.
void drawPanels(ViewerState& state);

} // namespace metamarch::viewer
