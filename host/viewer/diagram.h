// SPDX-License-Identifier: MIT
// A box at the window's right edge that holds a drawing. Measures and places are in heights of the text, from
// the box's upper left corner.
#pragma once
#include "metamarch/viewer/overlay.h"

#include <imgui.h>
#include <string>

namespace metamarch::viewer {

inline constexpr float kDiagramWidth = 30.0f;
inline constexpr float kWalkDiagramHeight = 19.0f;
inline constexpr float kTableDiagramHeight = 22.0f;

class Diagram {
  protected:
    // Draws the box, `top` below the window's upper edge.
    Diagram(const ViewerState& state, const float top, const float height)
        : text_(ImGui::GetFontSize()),
          corner_(static_cast<float>(state.size.x) - (kDiagramWidth + 1.0f) * text_, top * text_),
          list_(*ImGui::GetBackgroundDrawList()) {
        list_.AddRectFilled(at({0.0f, 0.0f}), at({kDiagramWidth, height}), kStoryShade, 4.0f);
    }

    ImDrawList& list() const { return list_; }
    ImVec2 at(const glm::vec2 place) const {
        return {corner_.x + place.x * text_, corner_.y + place.y * text_};
    }
    void write(const glm::vec2 place, const ImU32 color, const std::string& words) const {
        list_.AddText(at(place), color, words.c_str());
    }
    // Breaks the words into lines as wide as the box.
    void writeWrapped(const glm::vec2 place, const ImU32 color, const std::string& words) const {
        list_.AddText(ImGui::GetFont(), text_, at(place), color, words.c_str(), nullptr,
                      (kDiagramWidth - 2.0f * place.x) * text_);
    }

  private:
    float text_; // pixels
    glm::vec2 corner_;
    ImDrawList& list_;
};

} // namespace metamarch::viewer
