#include "metamarch/cli/progress.h"

#include <fmt/format.h>

#include <cstdio>
#include <unistd.h>
#include <utility>

namespace metamarch::cli {

Progress::Progress(std::string text, const bool wanted)
    : label(std::move(text)), visible(wanted && isatty(STDERR_FILENO) == 1) {
    show(0.0);
}

Progress::~Progress() {
    if (visible) {
        fmt::print(stderr, "\r\x1b[K");
    }
}

void Progress::show(const double part) {
    constexpr std::size_t kWidth = 40;
    const auto now = std::chrono::steady_clock::now();
    if (!visible || (part < 1.0 && now - lastDrawn < std::chrono::milliseconds(100))) {
        return;
    }
    lastDrawn = now;
    const auto filled = static_cast<std::size_t>(part * kWidth);
    fmt::print(stderr, "\r{} [{:#>{}}{:.>{}}] {:3.0f} %", label, "", filled, "", kWidth - filled,
               100.0 * part);
    std::fflush(stderr);
}

DeviceProgress::DeviceProgress(const bool progressWanted) : wanted(progressWanted) {
    bar.emplace("compiling", wanted);
}

void DeviceProgress::show(const double part) {
    if (std::exchange(isCompiling, false)) {
        bar.reset(); // clears its line before the next one draws
        bar.emplace("rendering", wanted);
    }
    bar->show(part);
}

} // namespace metamarch::cli
