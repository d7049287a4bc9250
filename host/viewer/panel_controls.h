// SPDX-License-Identifier: MIT
// Controls that the sections of the panel share. Call them within a window of Dear ImGui.
#pragma once
#include <imgui.h>
#include <string>
#include <vector>

namespace metamarch::viewer {

// The user may type a number into a slider; it is clamped as well.
inline constexpr ImGuiSliderFlags kTypedWithin = ImGuiSliderFlags_AlwaysClamp;

// Breaks a text that is wider than the panel.
inline void line(const std::string& text) { ImGui::TextWrapped("%s", text.c_str()); }

// Draws a list of names. Returns the name that the user chooses in this frame, otherwise `current`.
inline std::string chooseName(const char* const label, const std::string& current,
                              const std::vector<std::string>& names) {
    std::string chosen = current;
    if (ImGui::BeginCombo(label, current.c_str())) {
        for (const std::string& name : names) {
            if (ImGui::Selectable(name.c_str(), name == current)) {
                chosen = name;
            }
        }
        ImGui::EndCombo();
    }
    return chosen;
}

} // namespace metamarch::viewer
