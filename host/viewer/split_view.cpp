// SPDX-License-Identifier: MIT
#include "metamarch/viewer/split_view.h"

#include <algorithm>
#include <utility>

namespace metamarch::viewer {
namespace {

// Device time per frame for the coarse pictures: together with some 15 ms for copying and panels it fits into
// the 33 ms of 30 frames per second.
constexpr double kQuickSeconds = 0.016;
// Device time per frame once the coarse pictures are whole; an event waits at most about that long.
constexpr double kCalmSeconds = 0.06;
constexpr double kMeasuredSeconds = 0.5; // rates are means over this time

constexpr std::uint32_t kEmptyPixel = 0xff201c1a; // a dark grey, with either order of the channels

render::PathCounters countersOf(const Viewport& viewport) {
    render::PathCounters total;
    for (const ProgressiveImage* const progressive : {&viewport.coarseImage(), &viewport.fineImage()}) {
        if (const render::PathCounters* const part = progressive->counters()) {
            total.samples += part->samples;
            total.rays += part->rays;
            total.steps += part->steps;
            total.tests += part->tests;
        }
    }
    return total;
}

// Updates the rates of one viewport. Steps and tests stay where no ray has been traced.
void measureRates(ViewportStatistics& rates, const render::PathCounters& now,
                  const render::PathCounters& before, const double seconds) {
    const double rays = now.rays - before.rays;
    rates.raysPerSecond = rays / seconds;
    rates.samplesPerSecond = (now.samples - before.samples) / seconds;
    if (rays > 0.0) {
        rates.stepsPerRay = (now.steps - before.steps) / rays;
        rates.testsPerRay = (now.tests - before.tests) / rays;
    }
}

} // namespace

bool SplitView::areOf(const std::vector<std::string>& traversals, const glm::uvec2 windowSize) const {
    return size == windowSize && std::ranges::equal(viewports, traversals, {}, [](const auto& viewport) {
               return viewport->traversal();
           });
}

void SplitView::make(const render::DeviceScene& scene, const std::vector<std::string>& traversals,
                     const glm::uvec2 windowSize, const ShaderOverrides& shaders, const Backdrop& backdrop) {
    clearPictures();
    size = windowSize;
    for (const std::string& name : traversals) {
        viewports.push_back(std::make_unique<Viewport>(device, scene, name, size, shaders, backdrop));
    }
}

void SplitView::clear() {
    clearPictures();
    compiled.clear();
}

void SplitView::clearPictures() {
    viewports.clear();
    hasPicture = false;
    countersBefore = {};
}

void SplitView::start(const RenderRequest& wanted) {
    request = wanted;
    for (const auto& viewport : viewports) {
        viewport->start(request, share(kQuickSeconds));
    }
}

void SplitView::setTone(const ToneMapping& toneMapping) {
    for (const auto& viewport : viewports) {
        viewport->setTone(toneMapping);
    }
}

void SplitView::setDenoiser(const Denoiser* const denoiser) {
    for (const auto& viewport : viewports) {
        viewport->setDenoiser(denoiser);
    }
}

void SplitView::setFilter(const bool isWanted) {
    for (const auto& viewport : viewports) {
        viewport->setFilter(isWanted);
    }
}

void SplitView::setChannel(const std::string& name) {
    for (const auto& viewport : viewports) {
        viewport->setChannel(name);
    }
}

void SplitView::update() {
    for (const auto& viewport : viewports) {
        viewport->update();
    }
}

bool SplitView::isDenoising() const {
    return std::ranges::any_of(viewports,
                               [](const auto& viewport) { return viewport->fineImage().isDenoising(); });
}

bool SplitView::isWhole() const {
    return std::ranges::all_of(viewports, [](const auto& viewport) { return viewport->isWhole(); });
}

bool SplitView::advance() {
    if (!isWhole()) {
        // Submit several times: the first submissions are small, because their speed is not known yet.
        const Stopwatch stopwatch;
        do {
            for (const auto& viewport : viewports) {
                if (!viewport->isWhole()) {
                    advance(*viewport, share(kQuickSeconds));
                }
            }
        } while (!isWhole() && stopwatch.seconds() < kQuickSeconds);
        return true;
    }
    bool hasWorked = false;
    for (const auto& viewport : viewports) {
        hasWorked = advance(*viewport, share(kCalmSeconds)) || hasWorked;
    }
    return hasWorked;
}

bool SplitView::advance(Viewport& viewport, const double seconds) {
    if (viewport.isBeforeKernel()) {
        compiled.insert(viewport.traversal());
    }
    return viewport.advance(seconds);
}

bool SplitView::isBeforeKernel() const {
    return std::ranges::any_of(viewports, [&](const auto& viewport) {
        return viewport->isBeforeKernel() && !compiled.contains(viewport->traversal());
    });
}

void SplitView::paint(vulkan::Commands& commands, const Screen& screen, const float line) {
    hasPicture = hasPicture || (!viewports.empty() && isWhole());
    if (!hasPicture || size != screen.size) {
        for (const auto& viewport : viewports) { // their pictures must be brought up to date all the same
            viewport->record(commands, screen, 0, 0);
        }
        paintBefore(commands, screen);
        return;
    }
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < viewports.size(); ++i) {
        const std::uint32_t end = endOf(i, line, screen.size.x);
        viewports[i]->record(commands, screen, first, end);
        first = end;
    }
}

std::uint32_t SplitView::endOf(const std::size_t viewport, const float line,
                               const std::uint32_t width) const {
    const bool isLast = viewport + 1 == viewports.size();
    return isLast ? width : static_cast<std::uint32_t>(line * static_cast<float>(width));
}

const ProgressiveImage& SplitView::under(const std::uint32_t column, const float line) const {
    std::size_t viewport = 0;
    while (column >= endOf(viewport, line, size.x)) {
        ++viewport;
    }
    return viewports[viewport]->fineImage();
}

void SplitView::paintBefore(vulkan::Commands& commands, const Screen& screen) {
    if (screen.pixelsBefore == nullptr) {
        if (screen.isEmpty) {
            commands.fill(screen.pixels, kEmptyPixel);
        }
    } else if (screen.isEmpty) { // otherwise it has been stretched before
        stretched.record(commands, {*screen.pixelsBefore, screen.sizeBefore}, screen);
    }
}

void SplitView::measure(Statistics& statistics) {
    ++frames;
    for (std::size_t i = 0; i < statistics.viewports.size(); ++i) {
        ViewportStatistics& side = statistics.viewports[i];
        const std::string traversal = i < viewports.size() ? viewports[i]->traversal() : "";
        if (side.traversal != traversal) {
            side = {traversal};
        }
        if (i < viewports.size()) {
            const ProgressiveImage& fine = viewports[i]->fineImage();
            side.samples = fine.samples();
            side.seconds = fine.isWhole() ? fine.seconds() / std::max(fine.samples(), 1.0) : 0.0;
        }
    }
    statistics.filmSize = viewports.empty() ? glm::uvec2(0) : progressive().size();

    const double seconds = sinceMeasured.seconds();
    if (seconds < kMeasuredSeconds) {
        return;
    }
    statistics.framesPerSecond = frames / seconds;
    for (std::size_t i = 0; i < viewports.size(); ++i) {
        const render::PathCounters now = countersOf(*viewports[i]);
        measureRates(statistics.viewports[i], now, std::exchange(countersBefore[i], now), seconds);
    }
    sinceMeasured = Stopwatch();
    frames = 0;
}

} // namespace metamarch::viewer
