// SPDX-License-Identifier: MIT
#include "metamarch/viewer/walk_diagram.h"

#include "metamarch/viewer/diagram.h"
#include "metamarch/viewer/march_story.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace metamarch::viewer {
namespace {

constexpr ImU32 kToCome = IM_COL32(120, 125, 135, 110);
constexpr ImU32 kVisited = IM_COL32(190, 200, 215, 220);

// Measures in heights of the text.
constexpr float kStackWidth = 6.0f;
constexpr int kShownOnStack = 8;

class WalkDrawing : Diagram {
  public:
    WalkDrawing(const ViewerState& state, const std::size_t usedStep)
        : Diagram(state, 1.0f, kWalkDiagramHeight), march(state.march->log), walk(state.march->walk),
          step(usedStep), visits(visitsUpTo(walk, march, step)) {}

    void draw() const {
        write({0.6f, 0.4f}, kInk, "The same ray in the kd-tree, with a stack");
        drawTree();
        drawStack();
        if (visits > 0) {
            writeWrapped({0.6f, kWalkDiagramHeight - 5.6f}, kVisited, sentenceOf(walk, visits - 1));
        }
        drawCounters();
    }

  private:
    // Visits go from left to right, depth goes down.
    ImVec2 placeOf(const std::size_t visit, const float deepest) const {
        const glm::vec2 from(1.0f, 2.2f);
        const glm::vec2 to(kDiagramWidth - kStackWidth - 1.5f, kWalkDiagramHeight - 6.4f);
        const float last = std::max(static_cast<float>(walk.visits.size()) - 1.0f, 1.0f);
        const glm::vec2 part(static_cast<float>(visit) / last,
                             static_cast<float>(walk.visits[visit].depth) / deepest);
        return at(from + part * (to - from));
    }

    void drawTree() const {
        float deepest = 1.0f;
        for (const WalkVisit& visit : walk.visits) {
            deepest = std::max(deepest, static_cast<float>(visit.depth));
        }
        for (std::size_t i = 1; i < walk.visits.size(); ++i) {
            list().AddLine(placeOf(walk.visits[i].parent, deepest), placeOf(i, deepest),
                           i < visits ? kVisited : kToCome);
        }
        for (std::size_t i = 0; i < walk.visits.size(); ++i) {
            const WalkVisit& visit = walk.visits[i];
            const ImU32 color = i >= visits           ? kToCome
                                : !visit.isLeaf       ? kVisited
                                : visit.triangleCount ? marchColor(MarchPart::fullLeaf)
                                                      : marchColor(MarchPart::emptyLeaf);
            list().AddCircleFilled(placeOf(i, deepest), visit.isLeaf ? 3.5f : 2.0f, color);
        }
        if (visits > 0) {
            list().AddCircle(placeOf(visits - 1, deepest), 6.0f, kInk, 0, 2.0f);
        }
    }

    void drawStack() const {
        const float left = kDiagramWidth - kStackWidth;
        write({left, 1.9f}, kPicked, "stack");
        if (visits == 0) {
            return;
        }
        const std::vector<std::uint32_t>& stack = walk.visits[visits - 1].stack;
        const auto size = static_cast<int>(stack.size());
        const int first = std::max(size - kShownOnStack, 0);
        const float bottom = kWalkDiagramHeight - 6.6f;
        for (int i = first; i < size; ++i) {
            const float y = bottom - 1.2f * static_cast<float>(i - first);
            list().AddRect(at({left, y - 1.1f}), at({kDiagramWidth - 0.6f, y}), kPicked);
            write({left + 0.3f, y - 1.1f}, kPicked, fmt::format("{}", stack[static_cast<std::size_t>(i)]));
        }
        if (first > 0) {
            write({left, bottom}, kPicked, fmt::format("and {}", first));
        }
    }

    void drawCounters() const {
        std::uint32_t tests = 0;
        for (std::size_t i = 0; i <= step; ++i) {
            tests += march.steps[i].tests;
        }
        const std::uint32_t walked = visits > 0 ? walk.visits[visits - 1].tests : 0;
        write({0.6f, kWalkDiagramHeight - 3.0f}, kPicked,
              fmt::format("stack: {:>4} nodes of {}, {} tests", visits, walk.visits.size(), walked));
        write({0.6f, kWalkDiagramHeight - 1.6f}, marchColor(MarchPart::cell),
              fmt::format("table: {:>4} look-ups of {}, {} tests", step + 1, march.steps.size(), tests));
    }

    const MarchLog& march;
    const WalkLog& walk;
    std::size_t step;
    std::size_t visits;
};

} // namespace

void drawWalkDiagram(const ViewerState& state) {
    const auto step = state.shownStep();
    if (step && static_cast<float>(state.size.x) > 2.0f * kDiagramWidth * ImGui::GetFontSize() &&
        !state.march->walk.visits.empty()) {
        WalkDrawing(state, *step).draw();
    }
}

} // namespace metamarch::viewer
