// SPDX-License-Identifier: MIT
// The user's choices.
#pragma once
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/view_names.h"
#include "metamarch/settings/render_settings.h"

#include <cstdint>
#include <optional>
#include <set>
#include <string>

namespace metamarch::viewer {

// Returns true if the view's colours are a heat map, whose hottest colour stands for Settings::heatMax.
inline bool isHeatMap(const std::uint32_t view) {
    return render::kViewNames[view].scale == render::ViewScale::count;
}

// What the camera sees behind the scene. Light comes from the surroundings all the same.
struct BackdropChoice {
    enum class Kind { surroundings, off, solid, blurred };
    Kind kind = Kind::surroundings;
    glm::vec3 color{1.0f}; // of a solid one, in sRGB as the screen shows it

    bool operator==(const BackdropChoice&) const = default;
};

struct Settings {
    PathChoice path;
    std::optional<std::uint32_t> view; // kView…; none: the path tracer's picture
    std::string channel;               // of shownChannels(), in place of the picture; empty: none
    float heatMax = 32.0f;             // number of steps or tests with the hottest colour
    bool isHeatFitted = true;          // heatMax follows the picture of the left side
    std::string traversal;
    std::string secondTraversal; // of the right viewport; empty: there is one viewport
    float splitAt = 0.5f;        // the split line's place, as a fraction of the window's width
    ToneMapping tone;
    bool isDenoised = false;
    bool hasPreview = true;    // while the camera moves
    bool hasFilter = true;     // of the display, while the path tracer has few samples
    std::uint32_t samples = 1; // of each pixel, after which the path tracer stops
    std::uint32_t pixelFilter = kFilterBox;
    LightChoice light;
    BackdropChoice backdrop; // path.isTransparent follows its kind
    ImportOptions import;
    std::set<std::uint32_t> hiddenMeshes;
    bool hasPanels = true;
    bool hasReadOut = false; // of the pixel under the cursor
    bool hasHelp = false;    // the list of keys

    bool operator==(const Settings&) const = default;
};

} // namespace metamarch::viewer
