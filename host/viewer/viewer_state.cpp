// SPDX-License-Identifier: MIT
#include "metamarch/viewer/viewer_state.h"

#include "metamarch/file/standard_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace metamarch::viewer {

void declareControls(SettingList& controls, SettingList& lightControls, Settings& settings) {
    declareIntegrator(controls, settings.path, kFilmIntegrators);
    declarePath(controls, settings.path, settings.samples);
    declareTone(controls, settings.tone);
    declareLight(lightControls, settings.light);
}

void ViewerState::say(const std::string& line) {
    constexpr std::size_t kMostMessages = 8;
    printSummary(fmt::format("{}\n", line));
    messages.push_back({line, std::chrono::steady_clock::now()});
    if (messages.size() > kMostMessages) {
        messages.pop_front();
    }
}

std::vector<std::string> ViewerState::traversals() const {
    std::vector<std::string> names = {settings.traversal};
    if (hasSplit()) {
        names.push_back(settings.secondTraversal);
    }
    return names;
}

std::optional<std::size_t> ViewerState::shownStep() const {
    if (!march || marchStep < 1 || static_cast<std::size_t>(marchStep) > march->log.steps.size()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(marchStep) - 1;
}

namespace {

// Returns width / height of what no panel covers.
float freeAspect(const ViewerState& state) {
    return (static_cast<float>(state.size.x) - state.coveredLeft) / static_cast<float>(state.size.y);
}

// Moves a camera that looks at the middle of a model so that the model is in the middle of what no panel
// covers.
ViewCamera besidePanel(ViewCamera camera, const ViewerState& state) {
    // A panorama sees all around, so nothing lies beside the panel.
    camera.aside = camera.isPanorama ? 0.0f : 0.5f * state.coveredLeft / static_cast<float>(state.size.y);
    pan(camera, -camera.aside, 0.0f);
    return camera;
}

} // namespace

ViewCamera ViewerState::framed(const Bounds& bounds, const double verticalFov) const {
    return besidePanel(framing(bounds, freeAspect(*this), verticalFov), *this);
}

ViewCamera ViewerState::framed(const Bounds& bounds, const ViewCamera& from) const {
    return besidePanel(framing(bounds, freeAspect(*this), from), *this);
}

ViewCamera ViewerState::alongAxis(const Bounds& bounds, const glm::vec3& towards) const {
    return besidePanel(axisView(bounds, freeAspect(*this), towards, camera), *this);
}

std::optional<glm::uvec2> ViewerState::pixelUnderCursor() const {
    const bool isInside = glm::all(glm::greaterThanEqual(cursor, glm::vec2(0.0f))) &&
                          glm::all(glm::lessThan(cursor, glm::vec2(size)));
    return isInside && !isCursorOnPanel ? std::optional(glm::uvec2(zoom.toPicture(cursor))) : std::nullopt;
}

Camera ViewerState::traced() const {
    return makeCamera(sceneCameraOf(camera, *scene->whole), size.x, size.y, lensOf(camera));
}

glm::vec2 ViewerState::depthRange() const {
    const Camera seen = traced();
    const Bounds& bounds = scene->bounds;
    const glm::vec3 nearest = glm::clamp(seen.eye, bounds.lo, bounds.hi);
    const bool isPanorama = seen.projection == kProjectionPanorama;
    float least = isPanorama ? glm::length(nearest - seen.eye) : std::numeric_limits<float>::infinity();
    float most = 0.0f;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::vec3 corner(i & 1u ? bounds.hi.x : bounds.lo.x, i & 2u ? bounds.hi.y : bounds.lo.y,
                               i & 4u ? bounds.hi.z : bounds.lo.z);
        const glm::vec3 away = corner - seen.eye;
        const float depth = isPanorama ? glm::length(away) : glm::dot(away, seen.forward);
        least = isPanorama ? least : std::min(least, depth);
        most = std::max(most, depth);
    }
    // An empty scene has no depths; one that is flat has a single one.
    const bool isRange = std::isfinite(most) && most > std::max(least, 0.0f);
    return isRange ? glm::vec2(std::max(least, 0.0f), most) : glm::vec2(0.0f, std::max(2.0f * most, 1.0f));
}

} // namespace metamarch::viewer
