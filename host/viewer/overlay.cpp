// SPDX-License-Identifier: MIT
#include "metamarch/viewer/overlay.h"

#include "metamarch/render/view_names.h"
#include "metamarch/shared/false_color.h"
#include "metamarch/viewer/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <imgui.h>
#include <string>

namespace metamarch::viewer {
namespace {

constexpr ImU32 kInk = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kShade = IM_COL32(0, 0, 0, 150);
constexpr ImU32 kPicked = IM_COL32(255, 210, 60, 255);
constexpr ImU32 kRay = IM_COL32(255, 255, 255, 230);
constexpr ImU32 kEmptyLeaf = IM_COL32(90, 170, 255, 200); // a leaf without triangles
constexpr ImU32 kFullLeaf = IM_COL32(255, 150, 60, 230);  // a leaf whose triangles were tested
constexpr ImU32 kExitBox = IM_COL32(120, 255, 140, 200);  // the box that the ray may cross after the leaf
constexpr ImU32 kHit = IM_COL32(255, 60, 90, 255);

ImVec2 at(const glm::vec2 place) { return {place.x, place.y}; }

class Painter {
  public:
    explicit Painter(const Camera& usedCamera) : camera(usedCamera), list(*ImGui::GetBackgroundDrawList()) {}

    void line(const glm::vec3& from, const glm::vec3& to, const ImU32 color, const float width) {
        if (const auto shown = project(camera, from, to)) {
            list.AddLine(at((*shown)[0]), at((*shown)[1]), color, width);
        }
    }

    void dot(const glm::vec3& place, const ImU32 color, const float radius) {
        if (const auto shown = project(camera, place, place)) {
            list.AddCircleFilled(at((*shown)[0]), radius, color);
        }
    }

    void box(const Bounds& bounds, const ImU32 color, const float width) {
        const auto corner = [&](const unsigned i) {
            return glm::vec3(i & 1u ? bounds.hi.x : bounds.lo.x, i & 2u ? bounds.hi.y : bounds.lo.y,
                             i & 4u ? bounds.hi.z : bounds.lo.z);
        };
        for (unsigned i = 0; i < 8; ++i) {
            for (const unsigned axis : {1u, 2u, 4u}) {
                if (!(i & axis)) {
                    line(corner(i), corner(i | axis), color, width);
                }
            }
        }
    }

  private:
    const Camera& camera;
    ImDrawList& list;
};

void drawLabel(const glm::vec2 place, const std::string& text) {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddRectFilled({place.x - 4.0f, place.y - 2.0f}, {place.x + size.x + 4.0f, place.y + size.y + 2.0f},
                       kShade, 3.0f);
    list.AddText(at(place), kInk, text.c_str());
}

void drawPick(Painter& painter, const Pick& picked) {
    for (int i = 0; i < 3; ++i) {
        painter.line(picked.corners[i], picked.corners[(i + 1) % 3], kPicked, 2.0f);
    }
    painter.dot(picked.position, kPicked, 3.0f);
}

// Draws one step: the cell that was looked up, its leaf's exit box, and the point where the step begins.
void drawStep(Painter& painter, const Lattice& lattice, const FrozenMarch& march, const MarchStep& step,
              const bool isChosen) {
    const ImU32 leafColor = step.triangleCount > 0 ? kFullLeaf : kEmptyLeaf;
    painter.box(worldBox(lattice, step.exitBox), isChosen ? kExitBox : leafColor, isChosen ? 2.0f : 1.0f);
    painter.box(worldBox(lattice, {step.cell, step.cell + 1}), leafColor, isChosen ? 2.5f : 1.5f);
    painter.dot(march.origin + march.dir * step.tNear, leafColor, isChosen ? 5.0f : 3.0f);
}

void drawMarch(Painter& painter, const ViewerState& state) {
    const FrozenMarch& march = *state.march;
    const Lattice& lattice = state.scene->shown.structure->lattice;
    const std::vector<MarchStep>& steps = march.log.steps;
    const bool isHit = march.log.result.hit.triangleId != kNoTriangle;
    const float end = isHit ? steps.back().best.t : steps.empty() ? lattice.extent : steps.back().tFar;
    painter.line(march.origin, march.origin + march.dir * end, kRay, 2.0f);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const bool isChosen = static_cast<int>(i) + 1 == state.marchStep;
        if (state.marchStep == 0 || isChosen) {
            drawStep(painter, lattice, march, steps[i], isChosen);
        }
    }
    if (isHit) {
        painter.dot(march.origin + march.dir * end, kHit, 5.0f);
    }
}

void drawLegend(const ViewerState& state) {
    const std::uint32_t view = *state.settings.view;
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float text = ImGui::GetFontSize();
    const glm::vec2 size(16.0f * text, text);
    // The names of a split lie below.
    const float below = state.hasSplit() ? 3.0f * text : 0.0f;
    const glm::vec2 corner = glm::vec2(state.size) - size - glm::vec2(2.0f * text, 2.5f * text + below);
    list.AddRectFilled(at(corner - text), at(corner + size + glm::vec2(text, 2.0f * text)), kShade, 4.0f);
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) {
        const float left = static_cast<float>(i) / kSteps;
        const glm::vec3 color = heatColor((static_cast<float>(i) + 0.5f) / kSteps);
        list.AddRectFilled({corner.x + left * size.x, corner.y},
                           {corner.x + (left + 1.0f / kSteps) * size.x, corner.y + size.y},
                           ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, 1.0f}));
    }
    const std::string most = fmt::format("{:.0f}+", state.settings.heatMax);
    list.AddText({corner.x, corner.y + size.y + 2.0f}, kInk, "0");
    list.AddText({corner.x + size.x - ImGui::CalcTextSize(most.c_str()).x, corner.y + size.y + 2.0f}, kInk,
                 most.c_str());
    const std::string name(render::kViewNames[view].name);
    list.AddText({corner.x + 0.5f * (size.x - ImGui::CalcTextSize(name.c_str()).x), corner.y + size.y + 2.0f},
                 kInk, name.c_str());
}

std::string viewportText(const std::string& traversal, const double seconds) {
    return seconds > 0.0 ? fmt::format("{}: {:.1f} ms", traversal, seconds * 1e3) : traversal + ": ...";
}

void drawSplit(const ViewerState& state) {
    const glm::vec2 size(state.size);
    const float line = state.settings.splitAt * size.x;
    ImGui::GetBackgroundDrawList()->AddLine({line, 0.0f}, {line, size.y}, kInk, 2.0f);
    const std::string left = viewportText(state.settings.traversal, state.statistics.viewportSeconds[0]);
    const float y = size.y - 2.0f * ImGui::GetFontSize();
    drawLabel({line - ImGui::CalcTextSize(left.c_str()).x - 12.0f, y}, left);
    drawLabel({line + 12.0f, y},
              viewportText(state.settings.secondTraversal, state.statistics.viewportSeconds[1]));
}

} // namespace

void drawMessages(const ViewerState& state) {
    // The tests of the viewer compare pictures without messages.
    static const char* const wanted = std::getenv("METAMARCH_MESSAGE_SECONDS");
    static const std::chrono::duration<double> shown(wanted == nullptr ? 3.0 : std::atof(wanted));
    const auto now = std::chrono::steady_clock::now();
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float text = ImGui::GetFontSize();
    const float width = static_cast<float>(state.size.x) - 2.0f * text;
    float bottom = static_cast<float>(state.size.y) - 3.0f * text;
    for (auto at = state.messages.rbegin(); at != state.messages.rend() && now - at->time < shown; ++at) {
        const char* const words = at->text.c_str();
        const ImVec2 size = ImGui::CalcTextSize(words, nullptr, false, width);
        const ImVec2 corner(text, bottom - size.y);
        list.AddRectFilled({corner.x - 4.0f, corner.y - 2.0f},
                           {corner.x + size.x + 4.0f, corner.y + size.y + 2.0f}, kShade, 3.0f);
        list.AddText(ImGui::GetFont(), text, corner, kInk, words, nullptr, width);
        bottom -= size.y + 0.5f * text;
    }
}

void drawOverlay(const ViewerState& state) {
    const Camera camera = state.traced();
    Painter painter(camera);
    if (state.selected) {
        drawPick(painter, *state.selected);
    }
    if (state.march) {
        drawMarch(painter, state);
    }
    if (state.hasSplit()) {
        drawSplit(state);
    }
    if (state.settings.view && isHeatMap(*state.settings.view)) {
        drawLegend(state);
    }
}

void drawBusy(const ViewerState& state) {
    if (!state.busy.empty() && !state.playback.isPlaying) {
        drawLabel({12.0f, static_cast<float>(state.size.y) - 2.0f * ImGui::GetFontSize()}, state.busy);
    }
}

} // namespace metamarch::viewer
