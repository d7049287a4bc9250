// SPDX-License-Identifier: MIT
// How much work goes into one submission.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>

namespace metamarch::render {

// GPUs with a watchdog reset a device that is busy for seconds, and progress and Ctrl-C wait for a submission
// to end: so the seconds of each one decide the size of the next.
class WorkSize {
  public:
    static constexpr double kTargetSeconds = 0.075;

    // `units` is any measure of work, from 1 to `most`.
    explicit WorkSize(std::uint32_t limit) : most(limit) {}

    std::uint32_t units() const { return size; }

    // Takes what the submission of units() took and what the next one is to take, and returns the former
    // where it counts as tracing: the first submission also compiles the kernel on some drivers, so it holds
    // one unit and says nothing.
    double finished(const double seconds, const double targetSeconds = kTargetSeconds) {
        if (!std::exchange(warm, true)) {
            return 0.0;
        }
        const double wanted = size * targetSeconds / std::max(seconds, 1e-6);
        size = static_cast<std::uint32_t>(
            std::clamp(wanted, 1.0, std::min(size * 4.0, static_cast<double>(most))));
        return seconds;
    }

  private:
    std::uint32_t most;
    std::uint32_t size = 1;
    bool warm = false;
};

} // namespace metamarch::render
