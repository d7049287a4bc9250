// SPDX-License-Identifier: MIT
#include "metamarch/viewer/viewer_state.h"

#include "metamarch/file/standard_stream.h"

#include <fmt/format.h>

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

Camera ViewerState::traced() const {
    return makeCamera(sceneCameraOf(camera, *scene->whole), size.x, size.y, lensOf(camera));
}

} // namespace metamarch::viewer
