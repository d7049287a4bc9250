// SPDX-License-Identifier: MIT
// Turns mouse and keyboard input into changes of the viewer's state.
#pragma once
#include "metamarch/viewer/viewer_state.h"
#include "metamarch/viewer/window.h"

#include <optional>
#include <span>
#include <string_view>

namespace metamarch::viewer {

struct KeyHelp {
    std::string_view keys;
    std::string_view what;
};

// Every key and button, for the panel that lists them.
std::span<const KeyHelp> keyHelp();

class Controls {
  public:
    // Applies `input` to the state's camera and settings, and adds actions to the state. `seconds` have
    // passed since the last call. Ignores mouse or keyboard while a panel uses them.
    void apply(const Input& input, const Window& window, double seconds, ViewerState& state);

  private:
    enum class Drag { none, orbit, look, pan, split, picture };

    void applyButton(const ButtonChange& change, ViewerState& state);
    void applyKey(const KeyPress& press, ViewerState& state);
    static void applyOnce(const KeyPress& press, ViewerState& state);
    void drag(glm::vec2 cursor, ViewerState& state);
    void fly(const Window& window, double seconds, ViewerState& state) const;
    void click(glm::vec2 place, int modifiers, ViewerState& state) const;

    Drag dragging = Drag::none;
    glm::vec2 pressedAt{0.0f};
    glm::vec2 last{0.0f};
    bool hasMoved = false; // since the button went down
    int modifiersThen = 0;
};

} // namespace metamarch::viewer
