// SPDX-License-Identifier: MIT
// A render by the path tracer in passes over the whole picture, which can be looked at, stopped and
// continued.
#pragma once
#include "metamarch/render/adaptive.h"
#include "metamarch/render/film_run.h"
#include "metamarch/render/path_sampler.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace metamarch::render {

// Samples [first, end) of each pixel.
struct SampleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

struct RenderProgress {
    double part = 0.0;    // of the work, 0 to 1
    double samples = 0.0; // of all pixels, taken by this call
    double samplesLeft = 0.0;
    std::uint32_t nextSample = 0; // every pixel has the samples before this one
    std::uint32_t endSample = 0;  // with which the picture is complete
    bool isPassEnd = false;       // all pixels have the same number of samples
};

enum class RenderWish {
    goOn,
    show, // call onShow, then go on
    stop,
};

struct RenderResult;

// How a caller follows a render. The functions may be empty.
struct RenderControl {
    // Called after each submission, or each tile on the CPU, and once more at the end of each pass. No two
    // calls run at the same time.
    std::function<RenderWish(const RenderProgress&)> onStep{};
    // Gets the picture as it is, with its sums. Nothing is computed meanwhile.
    std::function<void(const RenderProgress&, const RenderResult&)> onShow{};
    // What an earlier render of the same picture has taken: RenderResult::sums. Without spans: nothing.
    FilmRun start{};
    bool keepsSums = false; // RenderResult::sums is wanted also at the end
    // The render ends with the pass that reaches this time; then all pixels have the same number of samples.
    double timeLimit = std::numeric_limits<double>::infinity(); // seconds
};

class PathRun {
  public:
    // The sampler has no samples. A start that does not belong to the range is refused by
    // std::invalid_argument.
    // An adaptive choice needs a range from 0 on.
    PathRun(PathSampler& sampler, const PathWork& work, SampleRange range, const RenderControl& control,
            const AdaptiveChoice& adaptive = {});

    using OnShow = std::function<void(const RenderProgress&)>;

    // Takes the samples of the range that are missing. Returns false if the control has stopped it. Calls
    // `show` where the control wishes to show the picture.
    bool take(const OnShow& show);

    // The sums so far; what comes last may be incomplete.
    FilmRun sums() const;

    // The number of samples that every pixel has, counted from the first of the range.
    std::uint32_t samples() const { return next_ - range_.first; }

  private:
    // A pass takes the samples [first, end) of each pixel.
    struct Pass {
        std::uint32_t first;
        std::uint32_t end;
    };

    std::uint32_t passEnd(std::uint32_t first) const;
    Pass nextPass() const;
    bool takePass(const Pass& pass, const OnShow& show);
    void chooseActive(std::uint32_t samples, const FilmData& film);
    void chooseActive();
    RenderProgress progressAt(const Pass& pass, double part) const;
    double seconds() const;

    PathSampler& sampler_;
    PathWork work_;
    SampleRange range_;
    const RenderControl& control_;
    AdaptiveChoice adaptive_;
    std::vector<std::uint8_t> active_; // which pixels take samples; none: all
    std::uint32_t decidedAt_ = 0;      // the number of samples by which that was decided
    std::vector<FilmSpan> complete_;   // of passes whose sums are their own
    std::uint32_t spanFirst_;          // of the sums that the sampler has, in a range that begins after 0
    std::uint32_t next_;
    double startSamples_ = 0.0; // of all pixels, that the start brought
    std::uint32_t begun_;       // what next_ was at the start
    std::chrono::steady_clock::time_point startTime_ = std::chrono::steady_clock::now();
};

} // namespace metamarch::render
