// SPDX-License-Identifier: MIT
// What a long render says of itself on standard error: a line on a terminal, or lines of JSON for programs.
#pragma once
#include "metamarch/render/path_run.h"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace metamarch::cli {

enum class ProgressForm { line, json, none };

// Draws on stderr while it lives: a line only if that is a terminal, and leaves it clean behind. JSON comes
// once a second.
class Progress {
  public:
    // `firstLabel` stands there until show() is called.
    Progress(std::string_view firstLabel, ProgressForm form);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(const render::RenderProgress& progress);

    // Whether a new value for setNoise() would be seen.
    bool wantsNoise() const;
    void setNoise(std::optional<double> value);

  private:
    void drawLine(std::string_view label, double part, const std::string& details);
    std::string detailsOf(const render::RenderProgress& progress) const;
    std::string jsonOf(const render::RenderProgress& progress) const;
    double seconds() const;
    double secondsLeft(const render::RenderProgress& progress) const;

    ProgressForm form;
    std::optional<double> noise;
    std::chrono::steady_clock::time_point startTime;
    std::chrono::steady_clock::time_point lastShown{};
    std::chrono::steady_clock::time_point lastNoise{};
};

} // namespace metamarch::cli
