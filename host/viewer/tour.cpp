// SPDX-License-Identifier: MIT
#include "metamarch/viewer/tour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <string>

namespace metamarch::viewer {
namespace {

constexpr TourScreen kTour[] = {
    {"A picture is made of rays",
     "Through each pixel goes a ray, and at each surface further rays begin. For each of them we look for "
     "the nearest "
     "triangle. To test every triangle for every ray would take minutes. The next screens show what leaves "
     "most of the tests out: "
     "a grid, a tree, and a table.",
     kViewHeadlight, "meta_table"},
    {"A uniform grid",
     "Space is cut into equal cells, and each cell lists its triangles. A ray goes from cell to cell. Bright "
     "pixels took many "
     "steps: a ray also walks through cells in which there is nothing.",
     kViewSteps,
     "uniform_grid",
     "",
     {},
     96.0f},
    {"The grid's tests",
     "The same rays, but bright pixels took many triangle tests. Where small triangles lie close together, a "
     "cell holds many "
     "of them, and a ray that enters the cell tests them all.",
     kViewTests,
     "uniform_grid",
     "",
     {},
     128.0f},
    {"A kd-tree",
     "A kd-tree halves space again and again, where that separates triangles from emptiness. Its leaves are "
     "large where "
     "nothing is, and small where much is. The steps are now nodes: a ray walks down from the root to each "
     "leaf on its way.",
     kViewSteps,
     "kd_stack",
     "",
     {},
     96.0f},
    {"The stack",
     "One ray, seen from the side. The drawing on the right is its walk through the tree. Where the ray "
     "meets "
     "both halves of a "
     "node, the far half waits on a stack. Behind a leaf without a hit, the last node on the stack comes "
     "next. Press Right and "
     "Left.",
     kViewHeadlight, "kd_stack", "", 0.4f},
    {"Cells over the tree",
     "Now a lattice of equal cells lies over the tree, so that each plane of the tree is a plane of the "
     "lattice. Thin lines "
     "divide cells, thick ones divide leaves: each leaf is a box of whole cells.",
     kViewCellBorders, "meta_table"},
    {"The meta table",
     "For each cell, a table holds the number of its leaf. Here each leaf has a colour. From a point to its "
     "leaf was a walk "
     "down the tree; now it is one look-up, without a stack.",
     kViewLeafId, "meta_table"},
    {"Exit boxes",
     "When the triangles of a leaf have been tested, the ray leaves its box. That box may be larger than the "
     "leaf: it grows "
     "over neighbours that hold no further triangle. So empty space is crossed in few, long steps.",
     kViewExitBoxes, "meta_table"},
    {"The march",
     "The same ray again. The line below tells each step: its cell, what the table says, what the leaf "
     "holds, and the cell to "
     "which we jump. Compare both counters. Press Right and Left, or Space. Alt+click marches another ray.",
     kViewHeadlight, "meta_table", "", 0.0f},
    {"Side by side",
     "Steps of the stack on the left, of the table on the right, with the same colours. Drag the line "
     "between them. Both "
     "find the same triangles, to the bit. T and V show the other traversals and views.",
     kViewSteps,
     "kd_stack",
     "meta_table",
     {},
     96.0f},
};

// The ray of the tour goes through this place of the first view, in heights of the window from its middle.
constexpr glm::vec2 kPlace(0.075f, -0.09f);
// The view of its march is the first one, turned by these angles (radians, to the right and down).
constexpr glm::vec2 kAside(0.84f, 0.36f);

void showMarch(ViewerState& state, const float part) {
    const glm::vec2 size(state.size);
    state.march = marchThrough(*state.scene, state.traced(), 0.5f * size + kPlace * size.y);
    const auto last = static_cast<float>(state.march->log.steps.size()) - 1.0f;
    state.marchStep = static_cast<int>(std::lround(part * std::max(last, 0.0f))) + 1;
    orbit(state.camera, kAside.x, kAside.y);
}

void choose(std::string& setting, const std::string_view traversal, const ViewerState& state) {
    if (traversal.empty() || std::ranges::find(state.runnable, traversal) != state.runnable.end()) {
        setting = traversal;
    }
}

} // namespace

std::span<const TourScreen> tour() { return kTour; }

void showTourScreen(ViewerState& state, const std::size_t index) {
    const TourScreen& screen = tour()[index];
    state.tourScreen = index;
    state.settings.view = screen.view;
    state.settings.channel.clear();
    state.settings.heatMax = screen.heatMax; // the same for pictures that are compared
    state.settings.isHeatFitted = false;
    choose(state.settings.traversal, screen.traversal, state);
    choose(state.settings.secondTraversal, screen.second, state);
    state.camera = state.history.first();
    state.march.reset();
    state.isMarchPlaying = false;
    if (screen.march) {
        showMarch(state, *screen.march);
    }
}

void drawTour(ViewerState& state) {
    if (!state.tourScreen || !state.scene) {
        return;
    }
    const std::size_t index = *state.tourScreen;
    const float text = ImGui::GetFontSize();
    const float width = std::min(34.0f * text, static_cast<float>(state.size.x) - 2.0f * text);
    ImGui::SetNextWindowPos({text, text}, ImGuiCond_Appearing);
    ImGui::SetNextWindowSize({width, 0.0f});
    ImGui::Begin(fmt::format("Tour: {} of {}###tour", index + 1, tour().size()).c_str(), nullptr,
                 ImGuiWindowFlags_NoResize);
    ImGui::TextUnformatted(tour()[index].title.data());
    ImGui::Separator();
    ImGui::TextWrapped("%s", tour()[index].text.data());
    if (ImGui::Button("back")) {
        state.actions.push_back(Action::previousScreen);
    }
    ImGui::SameLine();
    if (ImGui::Button("on")) {
        state.actions.push_back(Action::nextScreen);
    }
    ImGui::SameLine();
    if (ImGui::Button("this screen again")) {
        state.actions.push_back(Action::showScreenAgain);
    }
    ImGui::SameLine();
    if (ImGui::Button("leave the tour")) {
        state.tourScreen.reset();
    }
    ImGui::End();
}

} // namespace metamarch::viewer
