// SPDX-License-Identifier: MIT
// A guided tour from a uniform grid over the kd-tree to the march: screens that set up the window and explain
// it.
#pragma once
#include "metamarch/viewer/viewer_state.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace metamarch::viewer {

struct TourScreen {
    std::string_view title;
    std::string_view text;
    std::optional<std::uint32_t> view; // kView…; none: the path tracer's picture
    std::string_view traversal;
    std::string_view second = ""; // of the right side; empty: there is one side
    // Shows this part of the steps of a ray's march, from the side: 0 is the first step.
    std::optional<float> march = {};
    float heatMax = 32.0f; // Settings::heatMax
};

std::span<const TourScreen> tour();

// Sets up the window for a screen: views, traversals, camera and march. Everything can be changed from there.
// Call it with a scene; `index` is below tour().size().
void showTourScreen(ViewerState& state, std::size_t index);

// Draws the text of the screen, if the window shows one, with buttons to go on and to leave. Call it within a
// frame of Dear ImGui.
void drawTour(ViewerState& state);

} // namespace metamarch::viewer
