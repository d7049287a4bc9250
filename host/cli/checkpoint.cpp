// SPDX-License-Identifier: MIT
#include "metamarch/cli/checkpoint.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

namespace metamarch::cli {
namespace {

bool isSame(const std::string& a, const std::string& b) {
    std::error_code failure;
    return std::filesystem::equivalent(a, b, failure) && !failure;
}

std::string quoted(const std::string& value) { return value.empty() ? "nothing" : "`" + value + "`"; }

// Whether each pixel has exactly this number of samples.
bool hasSamples(const FilmData& film, const std::uint32_t count) {
    return std::ranges::all_of(film.pixels, [&](const FilmPixel& pixel) { return pixel.samples == count; });
}

// Whether the spans are as PathRun leaves them.
bool isRunOf(const render::FilmRun& run, const render::SampleRange range, const bool isAdaptive) {
    std::uint32_t next = range.first;
    for (const render::FilmSpan& span : run.spans) {
        const bool isLast = &span == &run.spans.back();
        const std::uint32_t count = span.film->samples();
        const bool isWhole =
            range.first > 0 ? count >= 1 && count <= kBlockSamples : count % kBlockSamples == 0;
        if (span.firstSample != next ||
            (!isLast && !(isWhole && (isAdaptive || hasSamples(*span.film, count))))) {
            return false;
        }
        next += count;
    }
    return !run.spans.empty() && (range.first > 0 || run.spans.size() <= 2) &&
           std::ranges::all_of(run.spans.back().film->pixels,
                               [](const FilmPixel& pixel) { return pixel.samples <= kBlockSamples; });
}

std::uint32_t mostSamples(const render::FilmSpan& span) { return span.firstSample + span.film->samples(); }

} // namespace

Checkpoint::Checkpoint(const std::string& path, const std::string& resumed) : file_(path) {
    if (file_.isThere() && !isSame(path, resumed)) {
        throw Error(
            ErrorKind::invalidArgument,
            fmt::format("--checkpoint {}: the file is there already; go on from it with `--resume {}`, or "
                        "remove it",
                        path, path));
    }
}

void Checkpoint::write(const render::FilmFile& file, const render::FilmRun& run) {
    file_.replace(render::FilmFileBytes(file, {&run, 1}).pieces());
}

void requireSamePicture(const render::FilmFile& wanted, const std::string& wantedName,
                        const render::FilmFile& file, const std::string& name) {
    const auto refuse = [&](const std::string& what, const std::string& there, const std::string& here) {
        throw Error(ErrorKind::inputRefused,
                    fmt::format("{}: is of another picture: {} is {} in it and {} in {}", name, what,
                                quoted(there), quoted(here), wantedName));
    };
    if (const auto fact = render::differingFact(wanted.facts, file.facts)) {
        refuse(*fact, render::factNamed(file.facts, *fact), render::factNamed(wanted.facts, *fact));
    }
    if (wanted.width != file.width || wanted.height != file.height) {
        refuse("--size", fmt::format("{}x{}", file.width, file.height),
               fmt::format("{}x{}", wanted.width, wanted.height));
    }
    // The first file's names stand for the hits of all.
    if (wanted.cryptomatte != file.cryptomatte) {
        throw Error(ErrorKind::inputRefused,
                    fmt::format("{}: is of another picture: its names of objects differ from those in {}",
                                name, wantedName));
    }
}

render::FilmRun takeRun(render::FilmFile file, const std::string& path, const render::FilmFile& wanted,
                        const PixelRect& area, const render::SampleRange range) {
    const auto refuse = [&](const std::string& what) {
        throw Error(ErrorKind::inputRefused, fmt::format("{}: {}", path, what));
    };
    requireSamePicture(wanted, "this command", file, path);
    if (file.runs.size() != 1) {
        refuse("holds several parts; merge them");
    }
    render::FilmRun run = std::move(file.runs.front());
    if (!(run.area == area)) {
        refuse("covers another area; give the same --crop");
    }
    if (run.spans.empty()) {
        return run;
    }
    if (run.spans.front().firstSample != range.first) {
        refuse(fmt::format("begins with sample {}; give the same --samples", run.spans.front().firstSample));
    }
    const bool isAdaptive = !render::factNamed(wanted.facts, "--noise-threshold").empty();
    if (!isRunOf(run, range, isAdaptive)) {
        refuse("is no checkpoint of a render");
    }
    if (mostSamples(run.spans.back()) > range.end) {
        refuse(fmt::format("has {} samples a pixel already, more than the {} wanted",
                           mostSamples(run.spans.back()), range.end));
    }
    return run;
}

} // namespace metamarch::cli
