// SPDX-License-Identifier: MIT
#include "metamarch/cli/progress.h"

#include "metamarch/file/standard_stream.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace metamarch::cli {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(const Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
}

// "1:02:03" or "2:03".
std::string clockText(const double seconds) {
    const auto whole = std::llround(seconds);
    const long long hours = whole / 3600;
    return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, whole / 60 % 60, whole % 60)
                     : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

} // namespace

Progress::Progress(const std::string_view firstLabel, const ProgressForm wanted)
    : form(wanted == ProgressForm::line && isatty(STDERR_FILENO) != 1 ? ProgressForm::none : wanted),
      startTime(Clock::now()) {
    if (form == ProgressForm::line) {
        drawLine(firstLabel, 0.0, "");
    }
}

Progress::~Progress() {
    if (form == ProgressForm::line) {
        printError("\r\x1b[K");
    }
}

double Progress::seconds() const { return secondsSince(startTime); }

double Progress::secondsLeft(const render::RenderProgress& progress) const {
    return progress.samples > 0.0 ? seconds() * progress.samplesLeft / progress.samples : 0.0;
}

void Progress::show(const render::RenderProgress& progress) {
    const double every = form == ProgressForm::json ? 1.0 : 0.1;
    const bool isEnd = progress.part >= 1.0 && progress.isPassEnd;
    if (form == ProgressForm::none || (!isEnd && secondsSince(lastShown) < every)) {
        return;
    }
    lastShown = Clock::now();
    if (form == ProgressForm::json) {
        printError(jsonOf(progress));
    } else {
        drawLine("rendering", progress.part, detailsOf(progress));
    }
}

bool Progress::wantsNoise() const { return form != ProgressForm::none && secondsSince(lastNoise) >= 1.0; }

void Progress::setNoise(const std::optional<double> value) {
    noise = value;
    lastNoise = Clock::now();
}

void Progress::drawLine(const std::string_view label, const double part, const std::string& details) {
    constexpr std::size_t kWidth = 24;
    const auto filled = static_cast<std::size_t>(part * kWidth);
    printError(fmt::format("\r\x1b[K{} [{:#>{}}{:.>{}}] {:3.0f} %{}", label, "", filled, "", kWidth - filled,
                           100.0 * part, details));
}

std::string Progress::detailsOf(const render::RenderProgress& progress) const {
    std::string text = fmt::format(", {} of {} samples", progress.nextSample, progress.endSample);
    if (progress.samples > 0.0) {
        text += fmt::format(", {:.2f} Msamples/s", progress.samples / seconds() * 1e-6);
    }
    text += fmt::format(", {} left", clockText(secondsLeft(progress)));
    if (noise) {
        text += fmt::format(", noise {:.2g} %", 100.0 * *noise);
    }
    return text;
}

std::string Progress::jsonOf(const render::RenderProgress& progress) const {
    nlohmann::ordered_json json;
    json["part"] = progress.part;
    json["samples"] = progress.nextSample;
    json["samplesPerPixel"] = progress.endSample;
    json["msamplesPerSecond"] = progress.samples / seconds() * 1e-6;
    json["seconds"] = seconds();
    json["secondsLeft"] = secondsLeft(progress);
    if (noise) {
        json["noise"] = *noise;
    }
    return json.dump() + "\n";
}

} // namespace metamarch::cli
