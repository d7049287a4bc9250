// SPDX-License-Identifier: MIT
#include "metamarch/cli/render_watch.h"

#include "metamarch/cli/warnings.h"
#include "metamarch/error/error.h"
#include "metamarch/render/noise.h"

#include <utility>

namespace metamarch::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr Seconds kCheckpointEvery{60.0};

// A failure to write does not end a render: the file is as it was, and the next attempt may succeed.
template <class Write>
void attempt(const Write& write) {
    try {
        write();
    } catch (const Error& error) {
        printWarnings({std::string(error.what()) + "; the render goes on"});
    }
}

} // namespace

RenderWatch::RenderWatch(const Choice& choice, WritePicture writePicture, WriteCheckpoint writeCheckpoint)
    : choice_(choice), writePicture_(std::move(writePicture)), writeCheckpoint_(std::move(writeCheckpoint)),
      progress_(std::in_place, choice.isOnDevice ? "compiling" : "rendering", choice.progress),
      lastPicture_(Clock::now()), lastCheckpoint_(Clock::now()) {}

void RenderWatch::follow(render::RenderControl& control) {
    control.onStep = [this](const render::RenderProgress& progress) { return onStep(progress); };
    control.onShow = [this](const render::RenderProgress& progress, const render::RenderResult& picture) {
        onShow(progress, picture);
    };
}

bool RenderWatch::isPictureDue() const {
    return isAsked_ || (choice_.writeEvery && Clock::now() - lastPicture_ >= Seconds(*choice_.writeEvery));
}

// Whoever asks for pictures more often wants as little lost of the sums.
bool RenderWatch::isCheckpointDue() const {
    return writeCheckpoint_ && (isPictureDue() || Clock::now() - lastCheckpoint_ >= kCheckpointEvery);
}

render::RenderWish RenderWatch::onStep(const render::RenderProgress& progress) {
    if (!signals_) {
        signals_.emplace();
    }
    progress_->show(progress);
    if (signals_->ending() != 0) {
        return render::RenderWish::stop;
    }
    isAsked_ = signals_->takeUserSignal() || isAsked_;
    const bool isNoiseDue = progress.isPassEnd && progress_->wantsNoise();
    return isPictureDue() || isCheckpointDue() || isNoiseDue ? render::RenderWish::show
                                                             : render::RenderWish::goOn;
}

void RenderWatch::onShow(const render::RenderProgress& progress, const render::RenderResult& picture) {
    if (progress.isPassEnd && progress_->wantsNoise()) {
        progress_->setNoise(render::noiseOf(picture.film));
    }
    const bool isComplete = progress.nextSample == progress.endSample;
    const bool isForPicture = isPictureDue() && !isComplete; // the end writes it anyway
    const bool isForCheckpoint = isCheckpointDue() && !isComplete;
    if (isForCheckpoint) {
        attempt([&] { writeCheckpoint_(picture.sums); });
        lastCheckpoint_ = Clock::now();
    }
    if (isForPicture) {
        attempt([&] { writePicture_(picture); });
        lastPicture_ = Clock::now();
        isAsked_ = false;
    }
}

} // namespace metamarch::cli
