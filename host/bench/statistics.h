// What several measurements of one thing come to.
#pragma once
#include <vector>

namespace metamarch::bench {

struct Summary {
    double median = 0.0;
    double spread = 0.0; // distance between the quartiles, as a fraction of the median
};

// The value below which the fraction `part` (0..1) of the values lies, on the straight line between its two
// neighbours in order. `values` must not be empty.
double quantile(std::vector<double> values, double part);

// `values` must not be empty; the spread of a median of 0 is 0.
Summary summarize(const std::vector<double>& values);

} // namespace metamarch::bench
