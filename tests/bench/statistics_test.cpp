// SPDX-License-Identifier: MIT
#include "metamarch/bench/measurement.h"

#include <gtest/gtest.h>

namespace metamarch::bench {
namespace {

TEST(Statistics, quantilesLieOnStraightLines) {
    EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2.0);
    EXPECT_EQ(quantile({4, 1, 2, 3}, 0.5), 2.5);
    EXPECT_EQ(quantile({4, 1, 2, 3}, 0.25), 1.75);
    EXPECT_EQ(quantile({7}, 0.75), 7.0);
    EXPECT_EQ(quantile({1, 9}, 0.0), 1.0);
    EXPECT_EQ(quantile({1, 9}, 1.0), 9.0);
}

TEST(Statistics, spreadIsTheQuartilesOverTheMedian) {
    const Summary summary = summarize({10, 30, 20, 40, 50});
    EXPECT_EQ(summary.median, 30.0);
    EXPECT_DOUBLE_EQ(summary.spread, 20.0 / 30.0); // quartiles 20 and 40
    EXPECT_EQ(summarize({5, 5, 5}).spread, 0.0);
    EXPECT_EQ(summarize({0, 0}).spread, 0.0);
}

TEST(Measurement, repeatsUntilThereAreRunsAndSecondsEnough) {
    int runs = 0;
    const auto run = [&] {
        ++runs;
        return 0.5;
    };
    const Summary speed = measureMraysPerSecond({3, 0.0}, 2000000, run);
    EXPECT_EQ(runs, 3);
    EXPECT_DOUBLE_EQ(speed.median, 4.0);
    runs = 0;
    measureMraysPerSecond({3, 2.6}, 1, run);
    EXPECT_EQ(runs, 6);
    runs = 0;
    EXPECT_EQ(measureMraysPerSecond({3, 1.0}, 0, run).median, 0.0);
    EXPECT_EQ(runs, 0);
}

} // namespace
} // namespace metamarch::bench
