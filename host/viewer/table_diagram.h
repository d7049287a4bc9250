// SPDX-License-Identifier: MIT
// Draws the part of the meta table that a step of the march reads: the brick's cells, each with the colour of
// its leaf, the entry that is read, and the ray.
#pragma once
#include "metamarch/viewer/viewer_state.h"

namespace metamarch::viewer {

// Call it within a frame of Dear ImGui, with a scene. Draws nothing unless a step of a march is chosen, or
// where the window is too small.
void drawTableDiagram(const ViewerState& state);

} // namespace metamarch::viewer
