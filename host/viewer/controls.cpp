// SPDX-License-Identifier: MIT
#define GLFW_INCLUDE_NONE
#include "metamarch/viewer/controls.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <utility>

namespace metamarch::viewer {
namespace {

constexpr float kTurnPerPixel = 0.006f;   // radians
constexpr float kClickSlack = 3.0f;       // pixels: a longer movement makes a click a drag
constexpr float kSplitReach = 6.0f;       // pixels: how near to the split line a press must be to drag it
constexpr float kZoomPerClick = 0.87f;    // factor of the distance
constexpr float kFlightPerSecond = 0.35f; // as a fraction of the scene's diagonal
constexpr double kLongestStep = 0.1;      // seconds: a longer frame moves no further
constexpr double kFovPerKey = 1.05;
constexpr float kStopsPerKey = 0.25f;

constexpr KeyHelp kHelp[] = {
    {"left drag", "orbit"},
    {"right drag", "look around"},
    {"middle or Shift+left drag", "pan"},
    {"wheel", "zoom to the cursor"},
    {"Ctrl+wheel", "zoom into the pixels; a drag then moves the picture"},
    {"W A S D, Q E", "fly; Shift: faster"},
    {"left click", "pick a triangle"},
    {"Ctrl+click", "focus there, with a lens"},
    {"Alt+click, M", "march the ray there, step by step"},
    {"Esc", "forget what is picked, and the march; back from A or B, or from pixels"},
    {"Home, F", "frame all; what is picked, or the step"},
    {"Enter", "the first view"},
    {"1 3 7, Ctrl", "from the front, right, top; the opposite"},
    {"Ctrl+Z, Ctrl+Shift+Z", "the view before, and back"},
    {"N", "the file's next camera"},
    {"C", "print the camera's options, and copy them"},
    {"V, Shift+V", "next view, the one before"},
    {"H", "heat map of steps, and back"},
    {"T", "next traversal"},
    {"X", "split: two traversals side by side"},
    {"K, Shift+K", "keep the view as A; as B"},
    {"J", "flip: A and B, or the only one and the present view"},
    {", .", "field of view"},
    {"- =", "exposure"},
    {"I", "read out the pixel under the cursor"},
    {"Space", "play the march, or else the animations; pause"},
    {"Left Right", "a step of the march, or else a 24th of a second, back or on"},
    {"Page Up, Page Down", "the tour: a screen back or on"},
    {"P, Shift+P", "save the picture (PNG); all that the window shows"},
    {"Ctrl+S", "save the film (EXR)"},
    {"Ctrl+P", "save each step of the march (PNG)"},
    {"R", "read the file again"},
    {"Tab", "panels"},
    {"F1, ?", "these keys"},
    {"Ctrl+Q", "quit"},
};

// Returns the point of the scene under the cursor; over the background, a point as far away as the target.
glm::vec3 pointUnder(const ViewerState& state, const glm::vec2 place) {
    const Camera camera = state.traced();
    if (const std::optional<Pick> found = pick(*state.scene, camera, place)) {
        return found->position;
    }
    const CameraRay view = cameraRayThrough(camera, place, vec2(0.0f));
    return view.origin + view.dir * glm::length(state.camera.target - state.camera.eye);
}

void march(const glm::vec2 place, ViewerState& state) {
    state.march = marchThrough(*state.scene, state.traced(), place);
    state.marchStep = 0;
    state.isMarchPlaying = false;
}

float diagonal(const ViewerState& state) {
    const Bounds& bounds = state.scene->bounds;
    return bounds.lo.x <= bounds.hi.x ? glm::length(bounds.hi - bounds.lo) : 1.0f;
}

} // namespace

std::span<const KeyHelp> keyHelp() { return kHelp; }

void Controls::apply(const Input& input, const Window& window, const double seconds, ViewerState& state) {
    const ImGuiIO& panels = ImGui::GetIO();
    if (!panels.WantTextInput) {
        for (const KeyPress& press : input.keys) {
            applyKey(press, state);
        }
    }
    if (!state.scene) {
        return;
    }
    for (const ButtonChange& change : input.buttons) {
        if (!panels.WantCaptureMouse || !change.isPressed) {
            applyButton(change, state);
        }
    }
    const glm::vec2 cursor = window.cursor();
    state.cursor = cursor;
    state.isCursorOnPanel = panels.WantCaptureMouse;
    drag(cursor, state);
    const glm::vec2 place = state.zoom.toPicture(cursor);
    if (input.scroll != 0.0f && !panels.WantCaptureMouse) {
        zoom(state.camera, std::pow(kZoomPerClick, input.scroll), pointUnder(state, place));
    }
    if (input.scrollWithCtrl != 0.0f && !panels.WantCaptureMouse) {
        state.zoom.scroll(input.scrollWithCtrl, cursor, state.size);
    }
    if (!panels.WantTextInput) {
        for (const KeyPress& press : input.keys) {
            if (press.key == GLFW_KEY_M && !press.isRepeat) {
                march(place, state);
            }
        }
        fly(window, seconds, state);
    }
}

void Controls::applyButton(const ButtonChange& change, ViewerState& state) {
    if (!change.isPressed) {
        drag(change.place, state);
        if (dragging != Drag::none && !hasMoved && change.button == GLFW_MOUSE_BUTTON_LEFT) {
            click(state.zoom.toPicture(pressedAt), modifiersThen, state);
        }
        dragging = Drag::none;
        return;
    }
    pressedAt = last = change.place;
    hasMoved = false;
    modifiersThen = change.modifiers;
    const float line =
        state.zoom.toWindow({state.settings.splitAt * static_cast<float>(state.size.x), 0.0f}).x;
    if (change.button == GLFW_MOUSE_BUTTON_LEFT) {
        const bool isOnLine = state.hasSplit() && std::abs(change.place.x - line) <= kSplitReach;
        dragging = isOnLine                            ? Drag::split
                   : state.zoom.isOn()                 ? Drag::picture
                   : change.modifiers & GLFW_MOD_SHIFT ? Drag::pan
                                                       : Drag::orbit;
    } else if (state.zoom.isOn()) {
        dragging = Drag::picture;
    } else if (change.button == GLFW_MOUSE_BUTTON_MIDDLE) {
        dragging = Drag::pan;
    } else if (change.button == GLFW_MOUSE_BUTTON_RIGHT) {
        dragging = Drag::look;
    }
}

void Controls::drag(const glm::vec2 cursor, ViewerState& state) {
    const glm::vec2 moved = cursor - std::exchange(last, cursor);
    hasMoved = hasMoved || glm::length(cursor - pressedAt) > kClickSlack;
    if (dragging == Drag::none || !hasMoved || moved == glm::vec2(0.0f)) {
        return;
    }
    const glm::vec2 size(state.size);
    switch (dragging) {
    case Drag::orbit:
        orbit(state.camera, moved.x * kTurnPerPixel, moved.y * kTurnPerPixel);
        break;
    case Drag::look:
        look(state.camera, moved.x * kTurnPerPixel, moved.y * kTurnPerPixel);
        break;
    case Drag::pan:
        pan(state.camera, -moved.x / size.y, moved.y / size.y);
        break;
    case Drag::split:
        state.settings.splitAt = std::clamp(state.zoom.toPicture(cursor).x / size.x, 0.0f, 1.0f);
        break;
    case Drag::picture:
        state.zoom.move(moved, state.size);
        break;
    case Drag::none:
        break;
    }
}

void Controls::click(const glm::vec2 place, const int modifiers, ViewerState& state) const {
    if (modifiers & GLFW_MOD_ALT) {
        march(place, state);
        return;
    }
    const std::optional<Pick> found = pick(*state.scene, state.traced(), place);
    if (!(modifiers & GLFW_MOD_CONTROL)) {
        state.selected = found;
    } else if (found) {
        constexpr float kFirstAperture = 0.01f; // as a fraction of the distance; replaces a pinhole
        state.camera.focusDistance = found->depth;
        if (state.camera.apertureRadius == 0.0f) {
            state.camera.apertureRadius = kFirstAperture * found->depth;
        }
    }
}

// The keys of which each press does one thing, however long they are held.
void Controls::applyOnce(const KeyPress& press, ViewerState& state) {
    std::vector<Action>& actions = state.actions;
    const bool isShifted = (press.modifiers & GLFW_MOD_SHIFT) != 0;
    if (press.modifiers & GLFW_MOD_CONTROL) {
        switch (press.key) {
        case GLFW_KEY_Q:
            actions.push_back(Action::quit);
            break;
        case GLFW_KEY_P:
            actions.push_back(Action::saveMarch);
            break;
        case GLFW_KEY_S:
            actions.push_back(Action::saveExr);
            break;
        case GLFW_KEY_Z:
            actions.push_back(isShifted ? Action::redoView : Action::undoView);
            break;
        case GLFW_KEY_1:
        case GLFW_KEY_KP_1:
            actions.push_back(Action::backView);
            break;
        case GLFW_KEY_3:
        case GLFW_KEY_KP_3:
            actions.push_back(Action::leftView);
            break;
        case GLFW_KEY_7:
        case GLFW_KEY_KP_7:
            actions.push_back(Action::bottomView);
            break;
        default:
            break;
        }
        return;
    }
    switch (press.key) {
    case GLFW_KEY_ESCAPE:
        actions.push_back(Action::clearMarks);
        break;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
        actions.push_back(Action::firstView);
        break;
    case GLFW_KEY_1:
    case GLFW_KEY_KP_1:
        actions.push_back(Action::frontView);
        break;
    case GLFW_KEY_3:
    case GLFW_KEY_KP_3:
        actions.push_back(Action::rightView);
        break;
    case GLFW_KEY_7:
    case GLFW_KEY_KP_7:
        actions.push_back(Action::topView);
        break;
    case GLFW_KEY_F1:
        actions.push_back(Action::toggleHelp);
        break;
    case GLFW_KEY_SLASH:
        if (isShifted) {
            actions.push_back(Action::toggleHelp);
        }
        break;
    case GLFW_KEY_PAGE_DOWN:
        actions.push_back(Action::nextScreen);
        break;
    case GLFW_KEY_PAGE_UP:
        actions.push_back(Action::previousScreen);
        break;
    case GLFW_KEY_SPACE:
        actions.push_back(Action::togglePlay);
        break;
    case GLFW_KEY_HOME:
        actions.push_back(Action::frameAll);
        break;
    case GLFW_KEY_F:
        actions.push_back(Action::frameSelected);
        break;
    case GLFW_KEY_N:
        actions.push_back(Action::nextCamera);
        break;
    case GLFW_KEY_C:
        actions.push_back(Action::printCamera);
        break;
    case GLFW_KEY_P:
        actions.push_back(isShifted ? Action::saveWindow : Action::saveScreenshot);
        break;
    case GLFW_KEY_K:
        actions.push_back(isShifted ? Action::keepB : Action::keepA);
        break;
    case GLFW_KEY_J:
        actions.push_back(Action::flipKept);
        break;
    case GLFW_KEY_I:
        actions.push_back(Action::toggleReadOut);
        break;
    case GLFW_KEY_R:
        actions.push_back(Action::reload);
        break;
    case GLFW_KEY_T:
        actions.push_back(Action::nextTraversal);
        break;
    case GLFW_KEY_V:
        actions.push_back(isShifted ? Action::previousView : Action::nextView);
        break;
    case GLFW_KEY_X:
        actions.push_back(Action::toggleSplit);
        break;
    case GLFW_KEY_TAB:
        actions.push_back(Action::togglePanels);
        break;
    case GLFW_KEY_H:
        state.settings.view = state.settings.view == kViewSteps ? std::nullopt : std::optional(kViewSteps);
        break;
    default:
        break;
    }
}

void Controls::applyKey(const KeyPress& press, ViewerState& state) {
    if (!press.isRepeat) {
        applyOnce(press, state);
    }
    if (press.modifiers & GLFW_MOD_CONTROL) {
        return;
    }
    switch (press.key) {
    case GLFW_KEY_LEFT:
        state.actions.push_back(Action::previousFrame);
        break;
    case GLFW_KEY_RIGHT:
        state.actions.push_back(Action::nextFrame);
        break;
    case GLFW_KEY_COMMA:
        state.camera.verticalFov = std::max(state.camera.verticalFov / kFovPerKey, 1.0);
        break;
    case GLFW_KEY_PERIOD:
        state.camera.verticalFov = std::min(state.camera.verticalFov * kFovPerKey, 170.0);
        break;
    case GLFW_KEY_MINUS:
        state.settings.tone.exposure -= kStopsPerKey;
        break;
    case GLFW_KEY_EQUAL:
        state.settings.tone.exposure += kStopsPerKey;
        break;
    default:
        break;
    }
}

void Controls::fly(const Window& window, const double seconds, ViewerState& state) const {
    if (window.isHeld(GLFW_KEY_LEFT_CONTROL) || window.isHeld(GLFW_KEY_RIGHT_CONTROL)) {
        return;
    }
    const auto held = [&](const int more, const int less) {
        return static_cast<float>(int{window.isHeld(more)} - int{window.isHeld(less)});
    };
    const glm::vec3 way(held(GLFW_KEY_D, GLFW_KEY_A), held(GLFW_KEY_E, GLFW_KEY_Q),
                        held(GLFW_KEY_W, GLFW_KEY_S));
    if (way == glm::vec3(0.0f)) {
        return;
    }
    const float faster = window.isHeld(GLFW_KEY_LEFT_SHIFT) ? 4.0f : 1.0f;
    const float length =
        diagonal(state) * kFlightPerSecond * faster * static_cast<float>(std::min(seconds, kLongestStep));
    viewer::fly(state.camera, way.x * length, way.y * length, way.z * length);
}

} // namespace metamarch::viewer
