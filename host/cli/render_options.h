// SPDX-License-Identifier: MIT
// The options of `render`, and what does not go together in them.
#pragma once
#include "metamarch/cli/output_check.h"
#include "metamarch/cli/picture_options.h"
#include "metamarch/cli/progress.h"
#include "metamarch/image/image_file.h"
#include "metamarch/render/render.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::cli {

enum class Backend { gpu, cpu };

struct RenderOptions : PictureOptions {
    RenderOptions() : PictureOptions(64) {}

    std::string outputPath;
    Backend backend = Backend::gpu;
    std::vector<std::string> aovs; // empty: what the integrator writes where nobody chooses
    float missDepth = std::numeric_limits<float>::infinity();
    double frameRate = 24.0; // frames per second, for the channel `motion`
    PictureStorage storage;
    bool isDenoised = false;
    CatcherChoice catcher;
    std::optional<render::SampleRange> samples;
    render::AdaptiveChoice adaptive;
    std::optional<PixelRect> crop;
    ProgressForm progress = ProgressForm::line;
    std::optional<double> writeEvery; // seconds
    std::optional<double> timeLimit;  // seconds
    std::string checkpointPath;
    std::string resumePath;
    std::string statsPath;
    bool isStamped = false;
    bool quiet = false;
    bool isVerbose = false;
};

// Returns true if the output is a .part: sums of samples, which `merge` puts together, in place of a picture.
bool isPart(const RenderOptions& options);

// Returns true if a channel of the picture needs the scene a frame later.
bool hasMotion(const RenderOptions& options);

void declareRender(SettingList& settings, RenderOptions& options);

// Throws Error(invalidArgument).
render::RenderSettings settingsOf(const RenderOptions& options);

// Throws Error(invalidArgument) for options that do not go together.
void checkArguments(const RenderOptions& options);

// Throws Error(invalidArgument) for what the output's format cannot hold.
void checkFormat(const RenderOptions& options);

std::vector<NamedFile> outputsOf(const RenderOptions& options);

// Refuses bad outputs before the long work. `given` are the settings that declareRender has declared.
void checkOutputs(const RenderOptions& options, const SettingList& given);

} // namespace metamarch::cli
