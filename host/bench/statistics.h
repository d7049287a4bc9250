// SPDX-License-Identifier: MIT
// Summarises repeated measurements.
#pragma once
#include <vector>

namespace metamarch::bench {

struct Summary {
    double median = 0.0;
    double spread = 0.0; // interquartile range as a fraction of the median
};

// Returns the quantile `part` (0..1) of the values, linearly interpolated between its two neighbours.
// `values` must not be empty.
double quantile(std::vector<double> values, double part);

// `values` must not be empty. If the median is 0, the spread is 0.
Summary summarize(const std::vector<double>& values);

} // namespace metamarch::bench
