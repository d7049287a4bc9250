// SPDX-License-Identifier: MIT
// Draws the stack traversal of the marched ray: the nodes in the order of their visits, and the stack.
#pragma once
#include "metamarch/viewer/viewer_state.h"

namespace metamarch::viewer {

// Call it within a frame of Dear ImGui, with a scene. Draws nothing unless a step of a march is chosen, or
// where the window is too narrow.
void drawWalkDiagram(const ViewerState& state);

} // namespace metamarch::viewer
