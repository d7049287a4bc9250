// SPDX-License-Identifier: MIT
#include "metamarch/bench/statistics.h"

#include <algorithm>
#include <cmath>

namespace metamarch::bench {

double quantile(std::vector<double> values, const double part) {
    std::sort(values.begin(), values.end());
    const double place = part * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
}

Summary summarize(const std::vector<double>& values) {
    const double median = quantile(values, 0.5);
    const double between = quantile(values, 0.75) - quantile(values, 0.25);
    return {median, median == 0.0 ? 0.0 : between / median};
}

} // namespace metamarch::bench
