// SPDX-License-Identifier: MIT
#include "metamarch/viewer/player.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace metamarch::viewer {
namespace {

constexpr double kSecondsOfStep = 0.8; // while a march plays

} // namespace

void Player::playAnimations(const double seconds, const bool isWaiting, ViewerState& state) {
    Playback& playback = state.playback;
    sincePose_ = playback.isPlaying ? sincePose_ + seconds : 0.0;
    if (!playback.isPlaying || !state.scene || isWaiting) {
        return;
    }
    const double length = state.scene->whole->animationSeconds();
    if (length <= 0.0) { // the file was read again and has no animation any more
        playback.isPlaying = false;
        return;
    }
    double time = state.settings.import.time.value_or(0.0) +
                  std::exchange(sincePose_, 0.0) * static_cast<double>(playback.speed);
    if (time > length) {
        playback.isPlaying = playback.isLooped;
        time = playback.isLooped ? std::fmod(time, length) : length;
    }
    state.settings.import.time = time;
}

void Player::playMarch(const double seconds, ViewerState& state) {
    if (isSaving_) { // no key changes which step is saved
        state.marchStep = savedSteps_ + 1;
        state.isMarchPlaying = false;
        return;
    }
    state.isMarchPlaying = state.isMarchPlaying && state.march;
    sinceStep_ = state.isMarchPlaying ? sinceStep_ + seconds : 0.0;
    if (sinceStep_ < kSecondsOfStep) {
        return;
    }
    sinceStep_ = 0.0;
    state.isMarchPlaying = static_cast<std::size_t>(++state.marchStep) < state.march->log.steps.size();
}

void Player::saveMarch(ViewerState& state) {
    if (!state.march || state.march->log.steps.empty()) {
        state.say("there is no march to save: Alt+click marches a ray");
        return;
    }
    isSaving_ = true;
    savedSteps_ = 0;
}

void Player::stepIsSaved(const std::string& path, ViewerState& state) {
    if (!state.march) { // removed since the picture was asked for
        isSaving_ = false;
        return;
    }
    ++savedSteps_;
    if (static_cast<std::size_t>(savedSteps_) < state.march->log.steps.size()) {
        return;
    }
    isSaving_ = false;
    state.say(fmt::format("saved {} steps, the last as {}", savedSteps_, path));
}

} // namespace metamarch::viewer
