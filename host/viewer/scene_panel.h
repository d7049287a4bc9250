// SPDX-License-Identifier: MIT
// The panel's sections of the scene: its cameras, and the parts of its file.
#pragma once
#include "metamarch/viewer/viewer_state.h"

namespace metamarch::viewer {

// Call them within a window of Dear ImGui, and only with a scene.
void drawCamera(ViewerState& state);
void drawScene(ViewerState& state);

} // namespace metamarch::viewer
