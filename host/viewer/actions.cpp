// SPDX-License-Identifier: MIT
#include "metamarch/viewer/actions.h"

#include "metamarch/render/scene_buffers.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/viewer/tour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace metamarch::viewer {
namespace {

void frameSelected(ViewerState& state) {
    if (!state.selected) {
        if (const std::optional<std::size_t> step = state.shownStep()) {
            state.camera = state.framed(
                worldBox(state.scene->shown.structure->lattice, state.march->log.steps[*step].exitBox),
                state.camera);
        }
        return;
    }
    const Scene& shown = *state.scene->shown.scene;
    Bounds bounds{state.selected->corners[0], state.selected->corners[0]};
    for (std::size_t i = 0; i < shown.triangles.size(); ++i) {
        if (shown.triangleMesh[i] == state.selected->mesh) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3& place = shown.positions[shown.triangles[i][corner]];
                bounds = {glm::min(bounds.lo, place), glm::max(bounds.hi, place)};
            }
        }
    }
    state.camera = state.framed(bounds, state.camera);
}

void nextCamera(ViewerState& state) {
    const std::vector<SceneCamera>& cameras = state.scene->whole->cameras;
    if (cameras.empty()) {
        state.say("the scene has no cameras");
        return;
    }
    const std::size_t next = state.camera.fileCamera ? (*state.camera.fileCamera + 1) % cameras.size() : 0;
    state.camera = ofFile(*state.scene->whole, next, distanceTo(state.scene->bounds, cameras[next].eye));
    state.say(fmt::format("camera {} '{}'", next, cameras[next].name));
}

// Returns the next traversal that the device can run.
std::string nextTraversal(const vulkan::DeviceReport& device, const std::string& current) {
    const std::span<const std::string_view> all = traversals();
    auto at = std::ranges::find(all, current);
    do {
        at = at + 1 == all.end() ? all.begin() : at + 1;
    } while (!render::missingFor(device, *at).empty());
    return std::string(*at);
}

void turnTo(ViewerState& state, const glm::vec3& towards) {
    state.camera = state.alongAxis(state.scene->bounds, towards);
}

void goTo(ViewerState& state, const std::optional<ViewCamera>& view, const char* const otherwise) {
    if (view) {
        state.camera = *view;
    } else {
        state.say(otherwise);
    }
}

// Poses the animations `seconds` later, within their length.
void moveTime(ViewerState& state, const double seconds) {
    const double length = state.scene->whole->animationSeconds();
    if (length <= 0.0) {
        state.say("the scene has no animation");
        return;
    }
    std::optional<double>& time = state.settings.import.time;
    time = std::clamp(time.value_or(0.0) + seconds, 0.0, length);
}

int stepsOf(const ViewerState& state) { return static_cast<int>(state.march->log.steps.size()); }

void togglePlay(ViewerState& state) {
    if (state.march) {
        state.isMarchPlaying = !state.isMarchPlaying;
        if (state.isMarchPlaying && state.marchStep >= stepsOf(state)) {
            state.marchStep = 0; // it has ended: play it again
        }
        return;
    }
    Playback& playback = state.playback;
    const double length = state.scene->whole->animationSeconds();
    playback.isPlaying = !playback.isPlaying && length > 0.0;
    if (length <= 0.0) {
        state.say("the scene has no animation");
    } else if (playback.isPlaying && state.settings.import.time.value_or(0.0) >= length) {
        state.settings.import.time = 0.0; // it has ended: play it again
    }
}

// By one step of the march, if there is one, otherwise by one frame of the animations.
void moveOn(ViewerState& state, const int by) {
    if (state.march) {
        state.marchStep = std::clamp(state.marchStep + by, 0, stepsOf(state));
        state.isMarchPlaying = false;
    } else {
        moveTime(state, by * Playback::kFrame);
    }
}

// Cycles through the path tracer's picture and all views.
void turnView(Settings& settings, const int by) {
    constexpr int kCount = static_cast<int>(render::kViewNames.size()) + 1;
    const int current = settings.view ? static_cast<int>(*settings.view) + 1 : 0;
    const int next = (current + by + kCount) % kCount;
    settings.channel.clear();
    settings.view = next == 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(next - 1));
}

void flipKept(ViewerState& state) {
    state.toShow = state.kept.next();
    if (state.toShow == state.kept.shown()) {
        state.say("nothing is kept: K keeps the view as A, Shift+K as B");
    }
}

// Goes to another screen of the tour, and begins the tour where there is none.
void turnScreen(ViewerState& state, const int by) {
    const int last = static_cast<int>(tour().size()) - 1;
    const int index = state.tourScreen ? static_cast<int>(*state.tourScreen) + by : 0;
    showTourScreen(state, static_cast<std::size_t>(std::clamp(index, 0, last)));
}

} // namespace

float distanceTo(const Bounds& scene, const glm::vec3& eye) {
    const float distance = glm::length(0.5f * (scene.lo + scene.hi) - eye);
    return std::isfinite(distance) && distance > 0.0f ? distance : 1.0f;
}

ViewCamera firstCamera(const LoadedScene& scene, const ViewerState& state) {
    const std::vector<SceneCamera>& cameras = scene.whole->cameras;
    return cameras.empty() ? state.framed(scene.bounds, ViewCamera().verticalFov)
                           : ofFile(*scene.whole, 0, distanceTo(scene.bounds, cameras[0].eye));
}

bool needsScene(const Action action) {
    return action != Action::toggleHelp && action != Action::togglePanels;
}

bool perform(const Action action, const vulkan::DeviceReport& device, ViewerState& state) {
    Settings& settings = state.settings;
    if (needsScene(action) && action != Action::undoView && action != Action::redoView) {
        state.history.keep(state.camera);
    }
    switch (action) {
    case Action::frameAll:
        state.camera = state.framed(state.scene->bounds, state.camera);
        return true;
    case Action::frameSelected:
        frameSelected(state);
        return true;
    case Action::firstView:
        state.camera = state.history.first();
        return true;
    case Action::frontView:
        turnTo(state, {0, 0, 1});
        return true;
    case Action::backView:
        turnTo(state, {0, 0, -1});
        return true;
    case Action::rightView:
        turnTo(state, {1, 0, 0});
        return true;
    case Action::leftView:
        turnTo(state, {-1, 0, 0});
        return true;
    case Action::topView:
        turnTo(state, {0, 1, 0});
        return true;
    case Action::bottomView:
        turnTo(state, {0, -1, 0});
        return true;
    case Action::undoView:
        goTo(state, state.history.undo(state.camera), "there is no view before");
        return true;
    case Action::redoView:
        goTo(state, state.history.redo(), "there is no later view");
        return true;
    case Action::clearMarks:
        if (state.kept.shown() != Shown::present) {
            state.toShow = Shown::present;
            return true;
        }
        if (state.zoom.isOn()) {
            state.zoom.end();
            return true;
        }
        state.selected.reset();
        state.march.reset();
        return true;
    case Action::flipKept:
        flipKept(state);
        return true;
    case Action::toggleHelp:
        settings.hasHelp = !settings.hasHelp;
        return true;
    case Action::toggleReadOut:
        settings.hasReadOut = !settings.hasReadOut;
        return true;
    case Action::togglePlay:
        togglePlay(state);
        return true;
    case Action::nextFrame:
        moveOn(state, 1);
        return true;
    case Action::previousFrame:
        moveOn(state, -1);
        return true;
    case Action::nextCamera:
        nextCamera(state);
        return true;
    case Action::nextTraversal:
        settings.traversal = nextTraversal(device, settings.traversal);
        return true;
    case Action::nextView:
        turnView(settings, 1);
        return true;
    case Action::previousView:
        turnView(settings, -1);
        return true;
    case Action::toggleSplit:
        settings.secondTraversal = state.hasSplit() ? "" : nextTraversal(device, settings.traversal);
        return true;
    case Action::togglePanels:
        settings.hasPanels = !settings.hasPanels;
        return true;
    case Action::nextScreen:
        turnScreen(state, 1);
        return true;
    case Action::previousScreen:
        turnScreen(state, -1);
        return true;
    case Action::showScreenAgain:
        turnScreen(state, 0);
        return true;
    case Action::keepA:
    case Action::keepB:
    case Action::printCamera:
    case Action::saveMarch:
    case Action::saveScreenshot:
    case Action::saveWindow:
    case Action::saveExr:
    case Action::reload:
    case Action::quit:
        return false;
    }
    return false;
}

} // namespace metamarch::viewer
