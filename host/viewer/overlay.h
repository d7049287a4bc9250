// SPDX-License-Identifier: MIT
// Draws lines and labels over the picture: the legend of a view, the split line, the picked triangle, the
// march of a ray, and messages.
#pragma once
#include "metamarch/viewer/viewer_state.h"

#include <cstdint>

namespace metamarch::viewer {

// Colours as Dear ImGui's ImU32: alpha, blue, green, red, a byte each.
inline constexpr std::uint32_t kInk = 0xffffffff;
inline constexpr std::uint32_t kStoryShade = 0xe1100c0a; // behind text and diagrams
inline constexpr std::uint32_t kPicked = 0xff3cd2ff;

// What is drawn of a march, each with a colour of its own.
enum class MarchPart { ray, cell, emptyLeaf, fullLeaf, exit, hit };
inline constexpr int kMarchParts = 6;
const char* nameOf(MarchPart part);
std::uint32_t marchColor(MarchPart part);      // as Dear ImGui's ImU32
std::uint32_t boxColor(const MarchStep& step); // of the exit box of the step's leaf

// Call it within a frame of Dear ImGui, and only with a scene.
void drawOverlay(ViewerState& state);

// Marks the pixel under the cursor, while the user has zoomed into pixels. Call it within a frame of Dear
// ImGui.
void drawZoom(const ViewerState& state);

// Draws ViewerState::readOut beside the cursor. Call it within a frame of Dear ImGui.
void drawReadOut(const ViewerState& state);

// Says what the window waits for. Call it within a frame of Dear ImGui.
void drawBusy(const ViewerState& state);

// Draws the newest messages for a few seconds. Call it within a frame of Dear ImGui.
void drawMessages(const ViewerState& state);

} // namespace metamarch::viewer
