// SPDX-License-Identifier: MIT
// What the window's parts share: controls and panels change it, the viewer acts on what has changed.
#pragma once
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/view_names.h"
#include "metamarch/settings/render_settings.h"
#include "metamarch/viewer/pick.h"
#include "metamarch/viewer/scene_loader.h"
#include "metamarch/viewer/view_camera.h"

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace metamarch::viewer {

// Whether Settings::heatMax says what the view's hottest colour means.
inline bool isHeatMap(const std::uint32_t view) {
    return render::kViewNames[view].scale == render::ViewScale::count;
}

// What the user has chosen.
struct Settings {
    PathChoice path;
    std::optional<std::uint32_t> view; // kView…; none: what the path tracer draws
    float heatMax = 32.0f;             // steps or tests of the hottest colour
    std::string traversal;
    std::string secondTraversal; // the right side's traversal; empty: there is one side
    float splitAt = 0.5f;        // of the window's width
    ToneMapping tone;
    std::uint32_t samples = 1; // where the path tracer stops
    std::uint32_t pixelFilter = kFilterBox;
    LightChoice light;
    ImportOptions import;
    std::set<std::uint32_t> hiddenMeshes;
    bool hasPanels = true;

    bool operator==(const Settings&) const = default;
};

// What a key or a button asks for, to be done once.
enum class Action {
    frameAll,
    frameSelected,
    nextCamera,
    printCamera,
    saveScreenshot,
    saveExr,
    reload,
    nextTraversal,
    nextView,
    previousView,
    toggleSplit,
    togglePanels,
    quit,
};

struct Statistics {
    double framesPerSecond = 0.0;
    double raysPerSecond = 0.0;
    double samplesPerSecond = 0.0;
    double stepsPerRay = 0.0;
    double testsPerRay = 0.0;
    double samples = 0.0;                    // of a pixel, so far
    std::array<double, 2> viewportSeconds{}; // that left and right took for their pictures; 0: under way
    std::uint64_t deviceBytes = 0;           // of the scene
    std::string device;                      // its name and driver
};

// Declares those settings that the panels show.
void declareControls(SettingList& controls, SettingList& lightControls, Settings& settings);

struct ViewerState {
    ViewerState() { declareControls(controls, lightControls, settings); }
    ViewerState(const ViewerState&) = delete; // the controls refer to the settings
    ViewerState& operator=(const ViewerState&) = delete;

    std::filesystem::path file;
    Settings settings;
    SettingList controls;      // what the panel always shows
    SettingList lightControls; // of these, those that the kind of light has
    ViewCamera camera;
    glm::uvec2 size{0}; // of the window, in pixels

    std::shared_ptr<const LoadedScene> scene; // none until the first one is there
    std::string busy;                         // what the window waits for; empty: for nothing
    std::deque<std::string> messages;         // the latest last
    std::string shaderError;                  // of the last change of a shader; empty: there is none
    std::string shaderFolder;                 // that is watched; empty: none
    std::vector<std::string> runnable;        // traversals that the device can run

    std::optional<Pick> selected;
    std::optional<FrozenMarch> march;
    int marchStep = 0; // that is drawn in full; 0: all
    Statistics statistics;

    std::vector<Action> actions;

    void say(const std::string& line);

    float aspect() const { return static_cast<float>(size.x) / static_cast<float>(size.y); }
    // Of the sides, from left to right.
    std::vector<std::string> traversals() const;
    bool hasSplit() const { return !settings.secondTraversal.empty(); }
    // What the device traces at the window's size. Only with a scene.
    Camera traced() const;
};

} // namespace metamarch::viewer
