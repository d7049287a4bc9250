// SPDX-License-Identifier: MIT
// Measures a speed: after a warm-up, until there are enough runs and enough time has passed.
#pragma once
#include "metamarch/bench/statistics.h"

#include <cstdint>
#include <functional>

namespace metamarch::bench {

struct Protocol {
    unsigned repeat = 5;  // minimum number of runs; at least 1
    double seconds = 0.5; // minimum of measured seconds
};

// Calls `run`, which traces `rayCount` rays and returns the seconds that it took, as often as `protocol`
// asks. The caller must have called it once before, because the first run compiles, fills caches and finds
// the size of submissions. Returns Mrays/s, or zero if there are no rays.
Summary measureMraysPerSecond(const Protocol& protocol, std::uint64_t rayCount,
                              const std::function<double()>& run);

} // namespace metamarch::bench
