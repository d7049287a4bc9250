// How a speed is measured: after a warm-up, until there are enough runs and enough time has gone by.
#pragma once
#include "metamarch/bench/statistics.h"

#include <cstdint>
#include <functional>

namespace metamarch::bench {

struct Protocol {
    unsigned repeat = 5;  // runs at least, 1 or more
    double seconds = 0.5; // measured seconds at least
};

// Runs `run`, which traces `rayCount` rays and returns the seconds that took, as `protocol` says. The caller
// has run it before: the first run compiles, fills caches and finds the size of submissions. Returns Mrays/s;
// zero where there is no ray.
Summary measureMraysPerSecond(const Protocol& protocol, std::uint64_t rayCount,
                              const std::function<double()>& run);

} // namespace metamarch::bench
