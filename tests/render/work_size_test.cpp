// SPDX-License-Identifier: MIT
// The time of one submission decides the size of the next.
#include "metamarch/render/work_size.h"

#include <gtest/gtest.h>

namespace metamarch::render {
namespace {

constexpr std::uint32_t kMost = 1000;

// Returns a WorkSize after the first submission.
WorkSize warmWork(const std::uint32_t most) {
    WorkSize work(most);
    work.finished(1.0);
    return work;
}

TEST(WorkSize, ignoresTheFirstSubmission) {
    for (const double seconds : {0.0, 1e-6, 100.0}) {
        WorkSize work(kMost);
        EXPECT_EQ(work.units(), 1u);
        EXPECT_EQ(work.finished(seconds), 0.0);
        EXPECT_EQ(work.units(), 1u);
    }
}

TEST(WorkSize, returnsTheSecondsOfTheOthers) {
    WorkSize work = warmWork(kMost);
    EXPECT_EQ(work.finished(0.5), 0.5);
    EXPECT_EQ(work.finished(0.25), 0.25);
}

TEST(WorkSize, growsFourfoldAtMost) {
    for (const double seconds : {0.0, 1e-9, 1e-3}) {
        WorkSize work = warmWork(kMost);
        std::uint32_t expected = 1;
        for (int i = 0; i < 3; ++i) {
            work.finished(seconds);
            expected *= 4;
            EXPECT_EQ(work.units(), expected);
        }
    }
}

TEST(WorkSize, neverPassesTheMost) {
    for (const std::uint32_t most : {1u, 2u, 5u, kMost, 0xffffffffu}) {
        WorkSize work = warmWork(most);
        for (int i = 0; i < 20; ++i) {
            work.finished(0.0);
            EXPECT_LE(work.units(), most);
        }
        EXPECT_EQ(work.units(), most);
    }
}

TEST(WorkSize, neverFallsToZero) {
    WorkSize work = warmWork(kMost);
    work.finished(1e-3);
    ASSERT_GT(work.units(), 1u);
    for (const double seconds : {1e3, 1e30}) {
        work.finished(seconds);
        EXPECT_EQ(work.units(), 1u);
    }
}

TEST(WorkSize, settlesWhereASubmissionTakesTheTarget) {
    constexpr double kSecondsPerUnit = 0.4e-3;
    WorkSize work = warmWork(kMost);
    for (int i = 0; i < 10; ++i) {
        work.finished(work.units() * kSecondsPerUnit);
    }
    EXPECT_NEAR(work.units() * kSecondsPerUnit, WorkSize::kTargetSeconds, kSecondsPerUnit);
}

TEST(WorkSize, settlesWhereASubmissionTakesAnotherTarget) {
    constexpr double kSecondsPerUnit = 0.1e-3;
    WorkSize work = warmWork(kMost);
    for (const double target : {0.02, 0.005, 0.08}) {
        for (int i = 0; i < 10; ++i) {
            work.finished(work.units() * kSecondsPerUnit, target);
        }
        EXPECT_NEAR(work.units() * kSecondsPerUnit, target, kSecondsPerUnit);
    }
}

} // namespace
} // namespace metamarch::render
