// SPDX-License-Identifier: MIT
// Decides how much work goes into one submission.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>

namespace metamarch::render {

// Every device takes this many workgroups in one dispatch: it is the least that maxComputeWorkGroupCount can
// be.
inline constexpr std::uint32_t kMostGroups = 65535;

// A submission must be short: GPUs with a watchdog reset a device that is busy for seconds, and progress and
// Ctrl-C wait until a submission ends. So the time of each submission decides the size of the next.
class WorkSize {
  public:
    static constexpr double kTargetSeconds = 0.075;

    // A unit can be any measure of work. A submission has from 1 to `limit` units.
    explicit WorkSize(std::uint32_t limit) : most(limit) {}

    std::uint32_t units() const { return size; }

    // Call it after a submission of units() that took `seconds`; it sets units() so that the next one takes
    // about `targetSeconds`. Returns `seconds`, or 0 for the first submission: on some drivers that one
    // includes compilation, so it has only one unit and its time is not a measure of tracing.
    double finished(const double seconds, const double targetSeconds = kTargetSeconds) {
        if (!std::exchange(warm, true)) {
            return 0.0;
        }
        secondsPerUnit = std::max(seconds / size, kKept * secondsPerUnit);
        const double wanted = targetSeconds / std::max(secondsPerUnit, 1e-6 / size);
        size = static_cast<std::uint32_t>(
            std::clamp(wanted, 1.0, std::min(size * 4.0, static_cast<double>(most))));
        return seconds;
    }

  private:
    // Units are not equally long: the memory of dear ones fades, so that a few cheap ones in between do not
    // make a submission that is too long.
    static constexpr double kKept = 0.7;

    std::uint32_t most;
    std::uint32_t size = 1;
    double secondsPerUnit = 0.0;
    bool warm = false;
};

} // namespace metamarch::render
