// SPDX-License-Identifier: MIT
#include "metamarch/cli/progress.h"

#include "metamarch/file/standard_stream.h"

#include <fmt/format.h>

#include <cstdio>
#include <unistd.h>

namespace metamarch::cli {

Progress::Progress(const std::string_view firstLabel, const bool wanted)
    : visible(wanted && isatty(STDERR_FILENO) == 1) {
    show(firstLabel, 0.0);
}

Progress::~Progress() {
    if (visible) {
        printError("\r\x1b[K");
    }
}

void Progress::show(const std::string_view newLabel, const double part) {
    constexpr std::size_t kWidth = 40;
    const auto now = std::chrono::steady_clock::now();
    const bool isDue = label != newLabel || part >= 1.0 || now - lastDrawn >= std::chrono::milliseconds(100);
    if (!visible || !isDue) {
        return;
    }
    lastDrawn = now;
    label = newLabel;
    const auto filled = static_cast<std::size_t>(part * kWidth);
    printError(fmt::format("\r\x1b[K{} [{:#>{}}{:.>{}}] {:3.0f} %", label, "", filled, "", kWidth - filled,
                           100.0 * part));
}

} // namespace metamarch::cli
