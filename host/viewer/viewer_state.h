// SPDX-License-Identifier: MIT
// The state that the window's parts share. Controls and panels change it, and the viewer reacts to changes.
#pragma once
#include "metamarch/settings/render_settings.h"
#include "metamarch/viewer/kept_views.h"
#include "metamarch/viewer/pick.h"
#include "metamarch/viewer/pixel_zoom.h"
#include "metamarch/viewer/scene_loader.h"
#include "metamarch/viewer/solid_box.h"
#include "metamarch/viewer/view_camera.h"
#include "metamarch/viewer/view_history.h"
#include "metamarch/viewer/viewer_settings.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::viewer {

// A request of a key or a button, to be performed once.
enum class Action {
    frameAll,
    frameSelected,
    firstView,
    frontView, // against the axes: +z, -z, +x, -x, +y, -y
    backView,
    rightView,
    leftView,
    topView,
    bottomView,
    undoView,
    redoView,
    clearMarks, // or back from a kept view, or from zoomed pixels
    keepA,
    keepB,
    flipKept,
    toggleHelp,
    toggleReadOut,
    togglePlay,
    nextFrame,
    previousFrame,
    nextCamera,
    printCamera,
    saveMarch,  // each step as the window shows it
    nextScreen, // of the tour
    previousScreen,
    showScreenAgain,
    saveScreenshot, // the picture alone
    saveWindow,     // with panels and lines
    saveExr,
    reload,
    nextTraversal,
    nextView,
    previousView,
    toggleSplit,
    togglePanels,
    quit,
};

struct Message {
    std::string text;
    std::chrono::steady_clock::time_point time;
};

// What one viewport has done.
struct ViewportStatistics {
    std::string traversal; // empty: there is no such viewport
    double samples = 0.0;  // mean number of samples per pixel so far
    double seconds = 0.0;  // of the device, per sample or for the whole view; 0: the first is not complete
    double raysPerSecond = 0.0;
    double samplesPerSecond = 0.0;
    double stepsPerRay = 0.0;
    double testsPerRay = 0.0;
};

struct Statistics {
    double framesPerSecond = 0.0;
    std::array<ViewportStatistics, 2> viewports; // left and right
    glm::uvec2 filmSize{0};                      // pixels; less than the window's where memory is short
    std::uint64_t deviceBytes = 0;               // of the scene
    std::string device;                          // its name and driver
};

// How an animation plays. The time itself is a setting, ImportOptions::time.
struct Playback {
    static constexpr double kFrame = 1.0 / 24.0; // seconds that a step by frame goes on

    bool isPlaying = false;
    float speed = 1.0f; // seconds of the animation in a second
    bool isLooped = true;
};

// The box of a march's step in this scene as it was drawn last, and what it depends on.
struct ShownBox {
    ViewCamera camera;
    glm::uvec2 size{0};
    Bounds box{};
    SolidBox solid;
};

// Declares the settings that the panels show.
void declareControls(SettingList& controls, SettingList& lightControls, Settings& settings);

struct ViewerState {
    ViewerState() { declareControls(controls, lightControls, settings); }
    ViewerState(const ViewerState&) = delete; // the controls refer to the settings
    ViewerState& operator=(const ViewerState&) = delete;

    std::filesystem::path file; // empty: none has been chosen yet
    Settings settings;
    SettingList controls;      // the panel shows all of them
    SettingList lightControls; // the panel shows those that apply to the chosen kind of light
    ViewCamera camera;
    glm::uvec2 size{0};       // of the window, in pixels
    float coveredLeft = 0.0f; // pixels of its width, from the left edge, that the panel covers

    std::shared_ptr<const LoadedScene> scene; // none until the first one is there
    std::optional<LoadStage> loadStage;       // while it waits for a scene
    std::string busy;                         // says what the window waits for; empty: nothing
    std::deque<Message> messages;             // the newest is the last
    std::string shaderError;                  // of the last change of a shader; empty: none
    std::string shaderFolder;                 // the folder that is watched; empty: none
    std::vector<std::string> runnable;        // the traversals that the device can run

    std::optional<Pick> selected;
    std::optional<FrozenMarch> march;
    int marchStep = 0; // number of the only step that is drawn, from 1; 0: all are
    bool isMarchPlaying = false;
    ShownBox shownBox;                     // of that step
    std::optional<std::size_t> tourScreen; // index in tour(); none: there is no tour
    PixelZoom zoom;                        // into the picture's pixels
    glm::vec2 cursor{0.0f};                // pixels of the window, from its upper left corner
    bool isCursorOnPanel = false;
    std::vector<std::string> readOut; // of the pixel there
    std::string_view filterRefusal;   // why the device does not filter the picture; empty: it does
    Statistics statistics;
    ViewHistory history;
    KeptViews kept;
    std::optional<Shown> toShow; // of them, in the next frame
    Playback playback;

    std::vector<Action> actions;
    std::vector<std::filesystem::path> recent; // scenes to choose from while there is none
    std::vector<std::filesystem::path> opened; // files that were chosen, to be taken as if they were dropped

    void say(const std::string& line);

    // Return a camera that sees the whole of `bounds` beside the panel: as framing(), or as axisView().
    ViewCamera framed(const Bounds& bounds, double verticalFov) const;
    ViewCamera framed(const Bounds& bounds, const ViewCamera& from) const;
    ViewCamera alongAxis(const Bounds& bounds, const glm::vec3& towards) const;
    // Returns the pixel of the picture that the user points at.
    std::optional<glm::uvec2> pixelUnderCursor() const;
    // Returns the traversals of the viewports, from left to right.
    std::vector<std::string> traversals() const;
    // Returns the index of the only step that is drawn; none if there is none, or if all are.
    std::optional<std::size_t> shownStep() const;
    bool hasSplit() const { return !settings.secondTraversal.empty(); }
    // Returns the camera that the device traces at the window's size. Call it only with a scene.
    Camera traced() const;
    // Returns the least and the greatest depth in the scene's box, as the view of depths has them: along the
    // view axis, or the distance in a panorama. The first is less than the second. Call it only with a scene.
    glm::vec2 depthRange() const;
};

} // namespace metamarch::viewer
