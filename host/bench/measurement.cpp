// SPDX-License-Identifier: MIT
#include "metamarch/bench/measurement.h"

#include <algorithm>

namespace metamarch::bench {
namespace {

constexpr double kShortestRun = 1e-9; // seconds; the clock may not have advanced

// Ends the measurement even if a run is too short for the clock.
constexpr std::size_t kMostRuns = 10000;

} // namespace

Summary measureMraysPerSecond(const Protocol& protocol, const std::uint64_t rayCount,
                              const std::function<double()>& run) {
    if (rayCount == 0) {
        return {};
    }
    std::vector<double> speeds;
    double total = 0.0;
    while (speeds.size() < protocol.repeat || (total < protocol.seconds && speeds.size() < kMostRuns)) {
        const double seconds = std::max(run(), kShortestRun);
        total += seconds;
        speeds.push_back(static_cast<double>(rayCount) * 1e-6 / seconds);
    }
    return summarize(speeds);
}

} // namespace metamarch::bench
