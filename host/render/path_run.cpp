// SPDX-License-Identifier: MIT
#include "metamarch/render/path_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace metamarch::render {
namespace {

// The number of samples of the block that every active pixel has.
std::uint32_t fewestSamples(const FilmData& film, const std::vector<std::uint8_t>& active) {
    std::uint32_t fewest = kBlockSamples;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        if (active.empty() || active[i] != 0) {
            fewest = std::min(fewest, film.pixels[i].samples);
        }
    }
    return fewest;
}

std::uint32_t blockEnd(const std::uint32_t sample) { return (sample / kBlockSamples + 1) * kBlockSamples; }

} // namespace

PathRun::PathRun(PathSampler& sampler, const PathWork& work, const SampleRange range,
                 const RenderControl& control, const AdaptiveChoice& adaptive)
    : sampler_(sampler), work_(work), range_(range), control_(control), adaptive_(adaptive),
      spanFirst_(range.first), next_(range.first), begun_(range.first) {
    if (control.start.spans.empty()) {
        sampler_.start(noSums(work, range.first));
        return;
    }
    if (!(control.start.area == work.area)) {
        throw std::invalid_argument("PathRun: the start covers another area");
    }
    for (const FilmSpan& span : control.start.spans) {
        for (const FilmPixel& pixel : span.film->pixels) {
            startSamples_ += pixel.samples;
        }
    }
    // The last span is the block that a pass was at.
    complete_ = control.start.spans;
    PathSums sums = noSums(work, complete_.back().firstSample);
    sums.block = *complete_.back().film;
    complete_.pop_back();
    if (range.first == 0 && !complete_.empty()) {
        sums.earlier = *complete_.front().film;
        complete_.clear();
    }
    spanFirst_ = sums.blockFirst;
    // With the samples before this block it was decided who takes it.
    chooseActive(sums.blockFirst, sums.earlier);
    next_ = sums.blockFirst + fewestSamples(sums.block, active_);
    begun_ = next_;
    sampler_.start(std::move(sums));
    if (!active_.empty()) {
        sampler_.setActive(active_);
    }
}

// Decides for the samples from number `samples` on, by the film of those before. It follows from them alone,
// so a render that goes on decides as one in one go.
void PathRun::chooseActive(const std::uint32_t samples, const FilmData& film) {
    decidedAt_ = samples;
    if (adaptive_.isOn() && samples >= adaptive_.minSamples) {
        active_ = activePixels(film, work_.area.width(), samples, adaptive_.threshold);
    }
}

void PathRun::chooseActive() {
    if (!adaptive_.isOn() || next_ % kBlockSamples != 0 || next_ == decidedAt_) {
        return;
    }
    PathSums sums = sampler_.sums();
    addBlock(sums.earlier, sums.block);
    chooseActive(next_, sums.earlier);
    if (!active_.empty()) {
        sampler_.setActive(active_);
    }
    if (!active_.empty() && std::ranges::find(active_, 1) == active_.end()) {
        next_ = range_.end;
    }
}

// With a range from 0 on, each pass goes on with the sums of those before. In any other range each pass has
// sums of its own: those of a block, so that a sum over all parts can be in the order of blocks; or of a
// sample before the first block of the range, because a block begun in another part gains its samples one by
// one.
std::uint32_t PathRun::passEnd(const std::uint32_t first) const {
    const bool isAlone = range_.first % kBlockSamples != 0 && first < blockEnd(range_.first);
    return isAlone ? first + 1 : std::min(blockEnd(first), range_.end);
}

PathRun::Pass PathRun::nextPass() const {
    Pass pass{next_, passEnd(next_)};
    if (std::isfinite(control_.timeLimit) && range_.first == 0) {
        // The first pass shows how long a sample takes.
        const double perSample = next_ > begun_ ? seconds() / (next_ - begun_) : control_.timeLimit;
        const double fitting = (control_.timeLimit - seconds()) / perSample;
        const double most = pass.end - pass.first;
        pass.end = pass.first + static_cast<std::uint32_t>(std::clamp(fitting, 1.0, most));
    }
    return pass;
}

double PathRun::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - startTime_).count();
}

RenderProgress PathRun::progressAt(const Pass& pass, const double part) const {
    const double taken = pass.first - range_.first + part * (pass.end - pass.first);
    const double pixels = static_cast<double>(work_.area.pixelCount());
    return {.part = taken / (range_.end - range_.first),
            .samples = std::max(pixels * taken - startSamples_, 0.0),
            .samplesLeft = pixels * (range_.end - range_.first - taken),
            .nextSample = part < 1.0 ? pass.first : pass.end,
            .endSample = range_.end,
            .isPassEnd = false};
}

bool PathRun::takePass(const Pass& pass, const OnShow& show) {
    RenderWish wish = RenderWish::goOn;
    RenderProgress progress;
    const auto onProgress = [&](const double part) {
        progress = progressAt(pass, part);
        wish = control_.onStep ? control_.onStep(progress) : RenderWish::goOn;
        return wish == RenderWish::goOn;
    };
    while (!sampler_.take(pass.end, onProgress)) {
        if (wish == RenderWish::stop) {
            return false;
        }
        show(progress);
        wish = RenderWish::goOn;
    }
    next_ = pass.end;
    progress = progressAt(pass, 1.0);
    progress.isPassEnd = true;
    const RenderWish atEnd = control_.onStep ? control_.onStep(progress) : RenderWish::goOn;
    if (atEnd == RenderWish::show || wish == RenderWish::show) {
        show(progress);
    }
    return wish != RenderWish::stop && atEnd != RenderWish::stop;
}

bool PathRun::take(const OnShow& show) {
    bool isOn = true;
    while (isOn && next_ < range_.end) {
        if (range_.first > 0 && next_ > spanFirst_ && next_ == passEnd(spanFirst_)) {
            complete_.emplace_back(spanFirst_, sampler_.sums().block);
            spanFirst_ = next_;
            sampler_.start(noSums(work_, spanFirst_));
        }
        chooseActive();
        isOn = next_ == range_.end || takePass(nextPass(), show);
        isOn = isOn && seconds() < control_.timeLimit;
    }
    return next_ == range_.end || seconds() >= control_.timeLimit;
}

FilmRun PathRun::sums() const {
    FilmRun run{.area = work_.area, .spans = complete_};
    PathSums sums = sampler_.sums();
    if (range_.first == 0 && sums.blockFirst > 0) {
        run.spans.emplace_back(0, std::move(sums.earlier));
    }
    run.spans.emplace_back(sums.blockFirst, std::move(sums.block));
    return run;
}

} // namespace metamarch::render
