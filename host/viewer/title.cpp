// SPDX-License-Identifier: MIT
#include "metamarch/viewer/title.h"

#include "metamarch/render/view_names.h"

#include <fmt/format.h>

#include <cstdint>

namespace metamarch::viewer {
namespace {

std::string seenText(const ViewerState& state) {
    const Settings& settings = state.settings;
    if (state.kept.shown() != Shown::present) {
        return fmt::format("{} as it was kept", nameOf(state.kept.shown()));
    }
    if (settings.view) {
        return std::string(render::kViewNames[*settings.view].name);
    }
    const std::string shown = settings.channel.empty() ? std::string(nameOf(settings.path.integrator))
                                                       : "channel " + settings.channel;
    const auto samples = static_cast<std::uint32_t>(state.statistics.viewports[0].samples);
    return fmt::format("{}, {} of {} samples", shown, samples, settings.samples);
}

// Nobody waits while an animation plays.
std::string waitingText(const ViewerState& state, const bool isPreparing) {
    return state.playback.isPlaying ? ""
           : isPreparing            ? " - preparing"
           : state.loadStage        ? fmt::format(" - {}", nameOf(*state.loadStage))
                                    : "";
}

} // namespace

std::string titleText(const ViewerState& state, const bool isPreparing) {
    if (state.file.empty()) {
        return "metamarch";
    }
    return fmt::format("{} - {} - {}{} - metamarch", state.file.filename().string(), seenText(state),
                       fmt::join(state.traversals(), " | "), waitingText(state, isPreparing));
}

} // namespace metamarch::viewer
