// SPDX-License-Identifier: MIT
#include "metamarch/viewer/overlay.h"

#include "metamarch/render/view_names.h"
#include "metamarch/shared/false_color.h"
#include "metamarch/viewer/march_story.h"
#include "metamarch/viewer/projection.h"
#include "metamarch/viewer/table_diagram.h"
#include "metamarch/viewer/walk_diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <imgui.h>
#include <string>

namespace metamarch::viewer {
namespace {

constexpr ImU32 kShade = IM_COL32(0, 0, 0, 150);

struct MarchColor {
    const char* name;
    ImU32 color;
};
// [MarchPart]
constexpr MarchColor kMarchColors[kMarchParts] = {
    {"the ray", IM_COL32(255, 255, 255, 230)},
    {"its cell", IM_COL32(120, 255, 140, 230)},
    {"box of an empty leaf", IM_COL32(90, 170, 255, 200)},
    {"box of a leaf with triangles", IM_COL32(255, 150, 60, 230)},
    {"exit, and the next cell", IM_COL32(205, 130, 255, 230)},
    {"hit", IM_COL32(255, 60, 90, 255)},
};
constexpr std::uint32_t kSolidAlpha = 110; // of a box's faces, of 255

ImVec2 at(const glm::vec2 place) { return {place.x, place.y}; }

class Painter {
  public:
    Painter(const Camera& usedCamera, const PixelZoom& usedZoom)
        : camera(usedCamera), zoom(usedZoom), list(*ImGui::GetBackgroundDrawList()) {}

    void line(const glm::vec3& from, const glm::vec3& to, const ImU32 color, const float width) {
        if (const auto shown = project(camera, from, to)) {
            list.AddLine(at(zoom.toWindow((*shown)[0])), at(zoom.toWindow((*shown)[1])), color, width);
        }
    }

    void dot(const glm::vec3& place, const ImU32 color, const float radius) {
        if (const auto shown = project(camera, place, place)) {
            list.AddCircleFilled(at(zoom.toWindow((*shown)[0])), radius, color);
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
    const PixelZoom& zoom;
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

// Draws one step among all: the cell that was looked up, its leaf's exit box, and the point where the step
// begins.
void drawStep(Painter& painter, const Lattice& lattice, const FrozenMarch& march, const MarchStep& step) {
    painter.box(worldBox(lattice, step.exitBox), boxColor(step), 1.0f);
    painter.box(worldBox(lattice, {step.cell, step.cell + 1}), boxColor(step), 1.5f);
    painter.dot(march.origin + march.dir * step.tNear, boxColor(step), 3.0f);
}

// Fills the parts of the faces that no surface hides.
void fillBox(const std::vector<SolidPart>& parts, const PixelZoom& zoom, const ImU32 color) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
    const ImVec4 base = ImGui::ColorConvertU32ToFloat4(color);
    for (const SolidPart& part : parts) {
        const ImU32 lit = ImGui::ColorConvertFloat4ToU32(
            {base.x * part.light, base.y * part.light, base.z * part.light, 0.0f});
        list.PrimReserve(6, 4);
        const auto first = static_cast<ImDrawIdx>(list._VtxCurrentIdx);
        for (const int corner : {0, 1, 2, 0, 2, 3}) {
            list.PrimWriteIdx(static_cast<ImDrawIdx>(first + corner));
        }
        for (const SolidPoint& point : part.corners) {
            list.PrimWriteVtx(at(zoom.toWindow(point.place)), white,
                              lit | (point.isSeen ? kSolidAlpha << IM_COL32_A_SHIFT : 0u));
        }
    }
}

// Hidden parts of edges are faint.
void drawEdges(const std::vector<SolidEdge>& edges, const PixelZoom& zoom, const ImU32 color) {
    constexpr ImU32 kFaint = 50u << IM_COL32_A_SHIFT;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const SolidEdge& edge : edges) {
        list.AddLine(at(zoom.toWindow(edge.ends[0])), at(zoom.toWindow(edge.ends[1])),
                     edge.isSeen ? color : (color & ~IM_COL32_A_MASK) | kFaint, edge.isSeen ? 1.5f : 1.0f);
    }
}

// Brings the box of the step up to date with camera, window and scene.
void followBox(ViewerState& state, const Camera& camera, const Bounds& box) {
    ShownBox& shown = state.shownBox;
    if (shown.camera == state.camera && shown.size == state.size && shown.box.lo == box.lo &&
        shown.box.hi == box.hi) {
        return;
    }
    shown = {state.camera, state.size, box, solidBox(*state.scene, camera, box)};
}

// Draws the only step: the leaf's box, the cell, the exit and the next cell.
void drawChosenStep(Painter& painter, const Camera& camera, ViewerState& state, const std::size_t index) {
    const FrozenMarch& march = *state.march;
    const Lattice& lattice = state.scene->shown.structure->lattice;
    const MarchStep& step = march.log.steps[index];
    const Bounds box = worldBox(lattice, step.exitBox);
    followBox(state, camera, box);
    fillBox(state.shownBox.solid.parts, state.zoom, boxColor(step));
    drawEdges(state.shownBox.solid.edges, state.zoom, boxColor(step));
    painter.box(worldBox(lattice, {step.cell, step.cell + 1}), marchColor(MarchPart::cell), 2.5f);
    painter.dot(march.origin + march.dir * step.tNear, marchColor(MarchPart::cell), 4.0f);
    if (step.isFinal) {
        return;
    }
    if (index + 1 < march.log.steps.size()) {
        const ivec3 next = march.log.steps[index + 1].cell;
        painter.box(worldBox(lattice, {next, next + 1}), marchColor(MarchPart::exit), 1.5f);
    }
    painter.dot(march.origin + march.dir * step.tFar, marchColor(MarchPart::exit), 4.0f);
}

// Places the names of a march's colours in lines of `width` from `corner` on, and draws them if there is a
// list. Returns their height.
float legendOf(const glm::vec2 corner, const float width, ImDrawList* const list) {
    const float text = ImGui::GetFontSize();
    glm::vec2 place(0.0f);
    for (int i = 0; i < kMarchParts; ++i) {
        const auto part = static_cast<MarchPart>(i);
        const float needed = ImGui::CalcTextSize(nameOf(part)).x + 1.1f * text;
        if (place.x > 0.0f && place.x + needed > width) {
            place = {0.0f, place.y + 1.3f * text};
        }
        const glm::vec2 from = corner + place;
        if (list != nullptr) {
            list->AddRectFilled(at(from), at(from + 0.8f * text), marchColor(part));
            list->AddText(at(from + glm::vec2(1.1f * text, -0.1f * text)), kInk, nameOf(part));
        }
        place.x += needed + 1.1f * text;
    }
    return place.y + 1.3f * text;
}

// Says above the window's lower edge what the step does, and what the colours mean. Returns how high above
// that edge its box ends.
float drawStory(const ViewerState& state, const std::size_t index) {
    const MarchLog& log = state.march->log;
    const std::string told =
        fmt::format("Step {} of {}. {}", index + 1, log.steps.size(), sentenceOf(log, index));
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float text = ImGui::GetFontSize();
    const float room = static_cast<float>(state.size.x) - state.coveredLeft;
    const float width = std::min(room - 2.0f * text, 70.0f * text);
    const ImVec2 size = ImGui::CalcTextSize(told.c_str(), nullptr, false, width);
    const float below = legendOf({}, width, nullptr);
    const glm::vec2 corner(state.coveredLeft + 0.5f * (room - width),
                           static_cast<float>(state.size.y) - size.y - below - 1.6f * text);
    list.AddRectFilled(at(corner - 0.5f * text),
                       at(corner + glm::vec2(width + 0.5f * text, size.y + below + 0.9f * text)), kStoryShade,
                       4.0f);
    list.AddText(ImGui::GetFont(), text, at(corner), kInk, told.c_str(), nullptr, width);
    legendOf(corner + glm::vec2(0.0f, size.y + 0.6f * text), width, &list);
    return static_cast<float>(state.size.y) - corner.y + 0.5f * text;
}

// Returns how much of the window's lower edge the step's story covers.
float drawMarch(Painter& painter, const Camera& camera, ViewerState& state) {
    const FrozenMarch& march = *state.march;
    const std::vector<MarchStep>& steps = march.log.steps;
    const std::optional<std::size_t> chosen = state.shownStep();
    const bool isHit = march.log.result.hit.triangleId != kNoTriangle && (!chosen || steps[*chosen].isFinal);
    const Lattice& lattice = state.scene->shown.structure->lattice;
    const float end = isHit           ? steps.back().best.t
                      : chosen        ? steps[*chosen].tFar
                      : steps.empty() ? lattice.extent
                                      : steps.back().tFar;
    if (chosen) {
        drawChosenStep(painter, camera, state, *chosen);
    }
    painter.line(march.origin, march.origin + march.dir * end, marchColor(MarchPart::ray), 2.0f);
    if (!chosen) {
        for (const MarchStep& step : steps) {
            drawStep(painter, lattice, march, step);
        }
    }
    if (isHit) {
        painter.dot(march.origin + march.dir * end, marchColor(MarchPart::hit), 5.0f);
    }
    if (!chosen) {
        return 0.0f;
    }
    drawWalkDiagram(state);
    drawTableDiagram(state);
    return drawStory(state, *chosen);
}

// The colours of a heat map or of depths, with the numbers that they stand for. `covered` pixels of the
// window's lower edge have something else.
void drawLegend(const ViewerState& state, const float covered) {
    const std::uint32_t view = *state.settings.view;
    const bool isHeat = isHeatMap(view);
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float text = ImGui::GetFontSize();
    const glm::vec2 size(16.0f * text, text);
    // The names of a split lie below.
    const float below = covered + (state.hasSplit() ? 3.0f * text : 0.0f);
    const glm::vec2 corner = glm::vec2(state.size) - size - glm::vec2(2.0f * text, 2.5f * text + below);
    list.AddRectFilled(at(corner - text), at(corner + size + glm::vec2(text, 2.0f * text)), kShade, 4.0f);
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) {
        const float left = static_cast<float>(i) / kSteps;
        const float part = (static_cast<float>(i) + 0.5f) / kSteps;
        const glm::vec3 color = isHeat ? heatColor(part) : depthColor(part);
        list.AddRectFilled({corner.x + left * size.x, corner.y},
                           {corner.x + (left + 1.0f / kSteps) * size.x, corner.y + size.y},
                           ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, 1.0f}));
    }
    const glm::vec2 range = isHeat ? glm::vec2(0.0f, state.settings.heatMax) : state.depthRange();
    const auto write = [&](const std::string& words,
                           const float place) { // 0: at the left end, 1: at the right
        const float x = corner.x + place * (size.x - ImGui::CalcTextSize(words.c_str()).x);
        list.AddText({x, corner.y + size.y + 2.0f}, kInk, words.c_str());
    };
    write(fmt::format("{:.4g}", range[0]), 0.0f);
    write(std::string(render::kViewNames[view].name), 0.5f);
    write(fmt::format("{:.4g}{}", range[1], isHeat ? "+" : ""), 1.0f);
}

std::string viewportText(const std::string& traversal, const double seconds) {
    return seconds > 0.0 ? fmt::format("{}: {:.1f} ms", traversal, seconds * 1e3) : traversal + ": ...";
}

void drawSplit(const ViewerState& state, const float covered) {
    const glm::vec2 size(state.size);
    const float line = state.zoom.toWindow({state.settings.splitAt * size.x, 0.0f}).x;
    ImGui::GetBackgroundDrawList()->AddLine({line, 0.0f}, {line, size.y}, kInk, 2.0f);
    const std::string left = viewportText(state.settings.traversal, state.statistics.viewports[0].seconds);
    const float y = size.y - covered - 2.0f * ImGui::GetFontSize();
    drawLabel({line - ImGui::CalcTextSize(left.c_str()).x - 12.0f, y}, left);
    drawLabel({line + 12.0f, y},
              viewportText(state.settings.secondTraversal, state.statistics.viewports[1].seconds));
}

} // namespace

const char* nameOf(const MarchPart part) { return kMarchColors[static_cast<std::size_t>(part)].name; }

std::uint32_t marchColor(const MarchPart part) { return kMarchColors[static_cast<std::size_t>(part)].color; }

std::uint32_t boxColor(const MarchStep& step) {
    return marchColor(step.triangleCount > 0 ? MarchPart::fullLeaf : MarchPart::emptyLeaf);
}

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

void drawOverlay(ViewerState& state) {
    const Camera camera = state.traced();
    Painter painter(camera, state.zoom);
    if (state.selected) {
        drawPick(painter, *state.selected);
    }
    const float covered = state.march ? drawMarch(painter, camera, state) : 0.0f;
    if (state.hasSplit()) {
        drawSplit(state, covered);
    }
    if (state.settings.view && render::kViewNames[*state.settings.view].scale != render::ViewScale::none) {
        drawLegend(state, covered);
    }
}

void drawZoom(const ViewerState& state) {
    const std::optional<glm::uvec2> under = state.pixelUnderCursor();
    if (!state.zoom.isOn() || !under) {
        return;
    }
    const float text = ImGui::GetFontSize();
    const glm::vec2 pixel(*under);
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.AddRect(at(state.zoom.toWindow(pixel) - 1.0f), at(state.zoom.toWindow(pixel + 1.0f) + 1.0f), kInk);
    drawLabel({0.5f * static_cast<float>(state.size.x), text},
              fmt::format("{} x, pixel {}, {}", state.zoom.scale(), pixel.x, pixel.y));
}

void drawReadOut(const ViewerState& state) {
    if (state.readOut.empty()) {
        return;
    }
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float text = ImGui::GetFontSize();
    glm::vec2 size(0.0f, text * static_cast<float>(state.readOut.size()));
    for (const std::string& line : state.readOut) {
        size.x = std::max(size.x, ImGui::CalcTextSize(line.c_str()).x);
    }
    // Right of the cursor and below it, or on the other side where that leaves the window.
    const glm::vec2 gap(1.5f * text);
    glm::vec2 corner = state.cursor + gap;
    for (const int axis : {0, 1}) {
        if (corner[axis] + size[axis] > static_cast<float>(state.size[axis])) {
            corner[axis] = std::max(state.cursor[axis] - gap[axis] - size[axis], 0.0f);
        }
    }
    list.AddRectFilled(at(corner - 0.4f * text), at(corner + size + 0.4f * text), kStoryShade, 3.0f);
    for (std::size_t i = 0; i < state.readOut.size(); ++i) {
        list.AddText(at(corner + glm::vec2(0.0f, text * static_cast<float>(i))), kInk,
                     state.readOut[i].c_str());
    }
}

void drawBusy(const ViewerState& state) {
    if (!state.busy.empty() && !state.playback.isPlaying) {
        const float text = ImGui::GetFontSize();
        const glm::vec2 corner(state.coveredLeft + 12.0f, static_cast<float>(state.size.y) - 2.0f * text);
        drawLabel(corner, state.busy);
        if (!state.loadStage) {
            return;
        }
        // A bar of one part for each stage: those before, and half of the present one.
        const float part = (static_cast<float>(*state.loadStage) + 0.5f) / static_cast<float>(kLoadStages);
        const glm::vec2 bar = corner + glm::vec2(0.0f, 1.3f * text);
        const glm::vec2 size(ImGui::CalcTextSize(state.busy.c_str()).x, 0.3f * text);
        ImDrawList& list = *ImGui::GetForegroundDrawList();
        list.AddRectFilled(at(bar), at(bar + size), kShade);
        list.AddRectFilled(at(bar), at(bar + glm::vec2(part * size.x, size.y)), kPicked);
    }
}

} // namespace metamarch::viewer
