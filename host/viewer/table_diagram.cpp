// SPDX-License-Identifier: MIT
#include "metamarch/viewer/table_diagram.h"

#include "metamarch/shared/false_color.h"
#include "metamarch/viewer/diagram.h"
#include "metamarch/viewer/table_slice.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace metamarch::viewer {
namespace {

// Measures in heights of the text.
constexpr float kTableTop = kWalkDiagramHeight + 2.0f; // below the drawing of the stack traversal
constexpr float kCellSide = 1.8f;
constexpr glm::vec2 kGrid(1.0f, 2.2f); // the upper left corner of the cells

class TableDrawing : Diagram {
  public:
    TableDrawing(const ViewerState& state, const MarchStep& usedStep)
        : Diagram(state, kTableTop, kTableDiagramHeight), march(*state.march), step(usedStep),
          lattice(state.scene->shown.structure->lattice),
          slice(tableSlice(state.scene->shown.structure->table, step.cell, march.dir)) {}

    void draw() const {
        write({0.6f, 0.4f}, kInk,
              fmt::format("The table: brick ({}, {}, {}), at {} = {}", slice.brick.x, slice.brick.y,
                          slice.brick.z, nameOf(across()), step.cell[across()]));
        drawCells();
        drawRay();
        const float side = kCellSide * TableSlice::kSide;
        write({kGrid.x + side + 0.8f, kGrid.y}, kInk, "up: " + std::string(1, nameOf(slice.axes[1])));
        write({kGrid.x + side + 0.8f, kGrid.y + 1.3f}, kInk,
              "right: " + std::string(1, nameOf(slice.axes[0])));
        write({kGrid.x + side + 0.8f, kGrid.y + 3.2f}, marchColor(MarchPart::cell), "the entry read");
        write({kGrid.x + side + 0.8f, kGrid.y + 4.5f}, kInk, fmt::format("leaf {}", step.leafId));
        write({kGrid.x + side + 0.8f, kGrid.y + 6.4f}, boxColor(step), "its exit box");
        const std::string told =
            slice.isOneWord
                ? "Each square is a cell. The whole brick is of one leaf, so the table has one word for it."
                : "Each square is a cell. Its colour is its leaf. The table has a word for each cell of "
                  "this brick.";
        writeWrapped({0.6f, kGrid.y + side + 0.6f}, kInk, told);
    }

  private:
    static char nameOf(const int axis) { return "xyz"[axis]; }
    int across() const { return 3 - slice.axes[0] - slice.axes[1]; }

    // Returns the place of a point of the lattice, in cells.
    ImVec2 placeOf(const vec3& point) const {
        const float right = point[slice.axes[0]] - static_cast<float>(slice.first[slice.axes[0]]);
        const float up = point[slice.axes[1]] - static_cast<float>(slice.first[slice.axes[1]]);
        return at(kGrid + kCellSide * glm::vec2(right, TableSlice::kSide - up));
    }

    void frame(const vec3& lo, const vec3& hi, const ImU32 color, const float width) const {
        const ImVec2 a = placeOf(lo);
        const ImVec2 b = placeOf(hi);
        list().AddRect({a.x, b.y}, {b.x, a.y}, color, 0.0f, 0, width);
    }

    void drawCells() const {
        for (int up = 0; up < TableSlice::kSide; ++up) {
            for (int right = 0; right < TableSlice::kSide; ++right) {
                const std::uint32_t leaf =
                    slice.leaves[static_cast<std::size_t>(up)][static_cast<std::size_t>(right)];
                if (leaf == TableSlice::kOutside) {
                    continue;
                }
                const vec3 color = idColor(leaf); // as in the view of leaf ids
                const glm::vec2 from = kGrid + kCellSide * glm::vec2(right, TableSlice::kSide - 1 - up);
                list().AddRectFilled(at(from + 0.04f), at(from + kCellSide - 0.04f),
                                     ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, 0.8f}));
            }
        }
    }

    void drawRay() const {
        const ImVec2 least = at(kGrid);
        const ImVec2 most = at(kGrid + kCellSide * TableSlice::kSide);
        list().PushClipRect({least.x - 1.0f, least.y - 1.0f}, {most.x + 1.0f, most.y + 1.0f}, true);
        frame(vec3(step.exitBox.lo), vec3(step.exitBox.hi), boxColor(step), 3.0f);
        frame(vec3(step.cell), vec3(step.cell + 1), marchColor(MarchPart::cell), 3.0f);
        const auto cellOf = [&](const float t) {
            return (march.origin + march.dir * t - lattice.origin) * lattice.cellsPerUnit;
        };
        list().AddLine(placeOf(cellOf(0.0f)), placeOf(cellOf(step.tFar)), marchColor(MarchPart::ray), 2.0f);
        list().AddCircleFilled(placeOf(cellOf(step.tNear)), 4.0f, marchColor(MarchPart::cell));
        list().AddCircleFilled(placeOf(cellOf(step.tFar)), 4.0f, marchColor(MarchPart::exit));
        list().PopClipRect();
    }

    const FrozenMarch& march;
    const MarchStep& step;
    const Lattice& lattice;
    TableSlice slice;
};

} // namespace

void drawTableDiagram(const ViewerState& state) {
    const auto step = state.shownStep();
    const glm::vec2 needed =
        glm::vec2(2.0f * kDiagramWidth, kTableTop + kTableDiagramHeight + 9.0f) * ImGui::GetFontSize();
    if (step && glm::all(glm::greaterThan(glm::vec2(state.size), needed))) {
        TableDrawing(state, state.march->log.steps[*step]).draw();
    }
}

} // namespace metamarch::viewer
