// SPDX-License-Identifier: MIT
// Looks after a render while it lasts: progress, pictures in between, checkpoints, signals.
#pragma once
#include "metamarch/cli/process.h"
#include "metamarch/cli/progress.h"
#include "metamarch/file/locked_file.h"
#include "metamarch/render/render.h"

#include <functional>
#include <optional>
#include <string>

namespace metamarch::cli {

class RenderWatch {
  public:
    struct Choice {
        ProgressForm progress = ProgressForm::line;
        std::optional<double> writeEvery; // seconds
        bool isOnDevice = false;
    };
    // Writes the picture, or the part, as it is.
    using WritePicture = std::function<void(const render::RenderResult&)>;
    // Writes the checkpoint; empty: there is none.
    using WriteCheckpoint = std::function<void(const render::FilmRun&)>;

    RenderWatch(const Choice& choice, WritePicture writePicture, WriteCheckpoint writeCheckpoint);

    // Adds to `control` what makes a render call this; the watch must outlive it.
    void follow(render::RenderControl& control);

    // Clears the line, before other words.
    void endProgress() { progress_.reset(); }

    // The signal that ended the render; 0: none.
    int signal() const { return signals_ ? signals_->ending() : 0; }

  private:
    render::RenderWish onStep(const render::RenderProgress& progress);
    void onShow(const render::RenderProgress& progress, const render::RenderResult& picture);
    bool isPictureDue() const;
    bool isCheckpointDue() const;

    Choice choice_;
    WritePicture writePicture_;
    WriteCheckpoint writeCheckpoint_;
    std::optional<Progress> progress_;
    std::optional<SignalWatch> signals_; // once there is something to write
    bool isAsked_ = false;               // SIGUSR1 asks for the picture
    std::chrono::steady_clock::time_point lastPicture_;
    std::chrono::steady_clock::time_point lastCheckpoint_;
};

} // namespace metamarch::cli
