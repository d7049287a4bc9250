// SPDX-License-Identifier: MIT
#include "metamarch/bench/hit_check.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace metamarch::bench {
namespace {

const RayResult kMiss{kFarthest, kNoTriangle, 0, 0};

std::uint64_t different(const RayResult& result, const RayResult& judged, const HitQuery query,
                        const HitTolerance& tolerance) {
    const RayQuery ray{{0, 0, 0}, 0, {0, 0, 2}, kFarthest}; // t counts lengths of 2
    return countDifferent({&ray, 1}, {&result, 1}, {&judged, 1}, query, tolerance);
}

TEST(HitCheck, wantsEveryBitOfDevicesThatKeepThem) {
    const HitTolerance exact = toleranceOn(true, Lattice{});
    const RayResult hit{1.0f, 7, 0, 0};
    EXPECT_EQ(different(hit, hit, HitQuery::closest, exact), 0u);
    EXPECT_EQ(different({1.0f, 8, 0, 0}, hit, HitQuery::closest, exact), 1u);
    EXPECT_EQ(different({std::nextafter(1.0f, 2.0f), 7, 0, 0}, hit, HitQuery::closest, exact), 1u);
    EXPECT_EQ(different(kMiss, hit, HitQuery::closest, exact), 1u);
    EXPECT_EQ(different(hit, kMiss, HitQuery::closest, exact), 1u);
    EXPECT_EQ(different(kMiss, {5.0f, kNoTriangle, 9, 9}, HitQuery::closest, exact), 0u);
}

TEST(HitCheck, comparesOnlyHitAndMissOfAnyHitRays) {
    EXPECT_EQ(different({1.0f, 7, 0, 0}, {2.0f, 8, 0, 0}, HitQuery::any, {}), 0u);
    EXPECT_EQ(different({1.0f, 7, 0, 0}, kMiss, HitQuery::any, {}), 1u);
}

TEST(HitCheck, allowsOtherDevicesTheMarginAndABudget) {
    Lattice lattice{};
    lattice.extent = 0x1p18f; // kReferenceMargin of it is 1
    const HitTolerance tolerance = toleranceOn(false, lattice);
    EXPECT_EQ(tolerance.distance, 1.0f);
    const RayResult hit{10.0f, 7, 0, 0};
    EXPECT_EQ(different({10.49f, 8, 0, 0}, hit, HitQuery::closest, tolerance), 0u); // 0.98 units apart
    EXPECT_EQ(different({10.51f, 7, 0, 0}, hit, HitQuery::closest, tolerance), 1u);
    EXPECT_TRUE(isWithinBudget(2, 100000, tolerance));
    EXPECT_FALSE(isWithinBudget(3, 100000, tolerance));
    EXPECT_TRUE(isWithinBudget(0, 10, HitTolerance{}));
    EXPECT_FALSE(isWithinBudget(1, 1000000, HitTolerance{}));
}

} // namespace
} // namespace metamarch::bench
