// SPDX-License-Identifier: MIT
#include "metamarch/file/standard_stream.h"

#include <atomic>
#include <cerrno>
#include <cstdio>

namespace metamarch {
namespace {

std::atomic<bool> isResultLost = false;

// Remembers whether the last call on standard output failed.
void recordResult(const bool isDone) noexcept {
    if (!isDone && errno != EPIPE) {
        isResultLost = true;
    }
}

} // namespace

void printResult(const std::string_view text) noexcept {
    recordResult(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

bool flushResults() noexcept {
    recordResult(std::fflush(stdout) == 0);
    return !isResultLost;
}

void printSummary(const std::string_view text) noexcept {
    flushResults();
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
}

void printError(const std::string_view text) noexcept {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

} // namespace metamarch
