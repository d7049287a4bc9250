#include "metamarch/viewer/sides.h"

#include <algorithm>

namespace metamarch::viewer {
namespace {

// A frame while something changes: a coarse picture and the panels fit into the 50 ms of 20 frames a second.
constexpr double kQuickSeconds = 0.025;
// A submission while nothing changes; the window waits for one at most.
constexpr double kCalmSeconds = 0.06;
constexpr double kMeasuredSeconds = 0.5; // that a rate is a mean over

constexpr std::uint32_t kEmptyPixel = 0xff201c1a; // dark, in either order of colours

} // namespace

bool Sides::areOf(const std::vector<std::string>& traversals, const glm::uvec2 windowSize) const {
    return size == windowSize && std::ranges::equal(canvases, traversals, {},
                                                    [](const auto& canvas) { return canvas->traversal(); });
}

void Sides::make(const render::DeviceScene& scene, const std::vector<std::string>& traversals,
                 const glm::uvec2 windowSize, const ShaderOverrides& shaders) {
    clear();
    size = windowSize;
    for (const std::string& name : traversals) {
        canvases.push_back(std::make_unique<Canvas>(device, scene, name, size, shaders));
    }
}

void Sides::clear() {
    canvases.clear();
    countersBefore = {};
}

void Sides::start(const Shot& wanted) {
    shot = wanted;
    for (const auto& canvas : canvases) {
        canvas->start(shot, share(kQuickSeconds));
    }
}

void Sides::setTone(const ToneMapping& toneMapping) {
    for (const auto& canvas : canvases) {
        canvas->setTone(toneMapping);
    }
}

bool Sides::isWhole() const {
    return std::ranges::all_of(canvases, [](const auto& canvas) { return canvas->isWhole(); });
}

bool Sides::advance() {
    if (!isWhole()) {
        // The first submissions are small: nobody knows yet how long they take.
        const Stopwatch stopwatch;
        do {
            for (const auto& canvas : canvases) {
                if (!canvas->isWhole()) {
                    canvas->advance(share(kQuickSeconds));
                }
            }
        } while (!isWhole() && stopwatch.seconds() < kQuickSeconds);
        return true;
    }
    bool hasWorked = false;
    for (const auto& canvas : canvases) {
        hasWorked = canvas->advance(share(kCalmSeconds)) || hasWorked;
    }
    return hasWorked;
}

void Sides::paint(vulkan::Commands& commands, const Screen& screen, const float line) {
    if (canvases.empty() || size != screen.size) {
        commands.fill(screen.pixels, kEmptyPixel);
        return;
    }
    std::uint32_t first = 0;
    for (const auto& canvas : canvases) {
        const bool isLast = canvas == canvases.back();
        const std::uint32_t end =
            isLast ? screen.size.x : static_cast<std::uint32_t>(line * static_cast<float>(screen.size.x));
        canvas->record(commands, screen, first, end);
        first = end;
    }
}

render::PathCounters Sides::counters() const {
    render::PathCounters total;
    for (const auto& canvas : canvases) {
        for (const Plate* const plate : {&canvas->coarsePlate(), &canvas->finePlate()}) {
            if (const render::PathCounters* const part = plate->counters()) {
                total.samples += part->samples;
                total.rays += part->rays;
                total.steps += part->steps;
                total.tests += part->tests;
            }
        }
    }
    return total;
}

void Sides::measure(Statistics& statistics) {
    ++frames;
    statistics.sideSeconds = {};
    for (std::size_t i = 0; i < canvases.size(); ++i) {
        const Plate& fine = canvases[i]->finePlate();
        statistics.sideSeconds[i] = fine.isWhole() ? fine.seconds() / std::max(fine.samples(), 1.0) : 0.0;
    }
    statistics.samples = canvases.empty() ? 0.0 : plate().samples();

    const double seconds = sinceMeasured.seconds();
    if (seconds < kMeasuredSeconds) {
        return;
    }
    const render::PathCounters total = counters();
    const double rays = total.rays - countersBefore.rays;
    statistics.framesPerSecond = frames / seconds;
    statistics.raysPerSecond = rays / seconds;
    statistics.samplesPerSecond = (total.samples - countersBefore.samples) / seconds;
    if (rays > 0.0) {
        statistics.stepsPerRay = (total.steps - countersBefore.steps) / rays;
        statistics.testsPerRay = (total.tests - countersBefore.tests) / rays;
    }
    countersBefore = total;
    sinceMeasured = Stopwatch();
    frames = 0;
}

} // namespace metamarch::viewer
