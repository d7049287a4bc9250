// SPDX-License-Identifier: MIT
// The order of tiles visits each tile once, and lets the time of one submission tell that of the next.
#include "metamarch/render/tiling.h"
#include "metamarch/render/work_size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace metamarch::render {
namespace {

Tiling tilingOf(const std::uint32_t perRow, const std::uint32_t rows) {
    return Tiling(PixelRect{0, 0, perRow * kTileSide, rows * kTileSide});
}

TEST(TileOrder, visitsEachTileOnce) {
    for (const std::uint32_t perRow : {1u, 2u, 3u, 8u, 13u, 160u}) {
        for (const std::uint32_t rows : {1u, 2u, 4u, 5u, 6u, 90u, 101u}) {
            const Tiling tiling = tilingOf(perRow, rows);
            ASSERT_EQ(tiling.count, perRow * rows);
            std::vector<int> visits(tiling.count);
            for (std::uint32_t place = 0; place < tiling.count; ++place) {
                ++visits.at(tileAt(tiling.order, place));
            }
            EXPECT_EQ(std::ranges::count(visits, 1), tiling.count) << perRow << " x " << rows;
        }
    }
}

TEST(TileOrder, visitsEachPixelOfATileOnce) {
    for (std::uint32_t i = 0; i < kTilePixels; ++i) {
        const uvec2 pixel = pixelInTile(i);
        EXPECT_LT(pixel.x, kTileSide);
        EXPECT_LT(pixel.y, kTileSide);
        EXPECT_EQ(placeInTile(pixel.x, pixel.y), i);
        EXPECT_EQ(placeInTile(pixel.x + 3 * kTileSide, pixel.y + 5 * kTileSide), i);
    }
}

TEST(TileOrder, hasACompactBlockForEachVector) {
    for (const auto& [lanes, block] : {std::pair(4u, uvec2(4, 1)), std::pair(8u, uvec2(4, 2)),
                                       std::pair(16u, uvec2(8, 2)), std::pair(32u, uvec2(8, 4))}) {
        for (std::uint32_t first = 0; first < kTilePixels; first += lanes) {
            uvec2 lo(kTileSide);
            uvec2 hi(0);
            for (std::uint32_t i = first; i < first + lanes; ++i) {
                lo = min(lo, pixelInTile(i));
                hi = max(hi, pixelInTile(i) + 1u);
            }
            EXPECT_EQ(hi - lo, block) << lanes << " lanes from " << first;
        }
    }
}

TEST(TileOrder, holdsPartsOfTilesAtTheEdge) {
    const Tiling tiling(PixelRect{3, 5, 3 + 17, 5 + 8});
    EXPECT_EQ(tiling.order.perRow, 3u);
    EXPECT_EQ(tiling.order.rows, 1u);
}

// The largest picture that the program draws has 2^16 pixels on a side: no product overflows.
TEST(TileOrder, visitsEachRowOfAHugePictureInTurn) {
    const Tiling tiling = tilingOf(8192, 8192);
    std::vector<int> visits(8192);
    for (std::uint32_t i = 0; i < 8192; ++i) {
        ++visits.at(tileAt(tiling.order, tiling.count - 1 - i) / 8192);
    }
    EXPECT_EQ(std::ranges::count(visits, 1), 8192);
}

// Returns the largest time of a submission, as a multiple of the target. `cost` is the time of a tile.
double longestSubmission(const std::function<double(double x, double y)>& cost) {
    const Tiling tiling = tilingOf(160, 90);
    WorkSize work(tiling.count);
    double longest = 0.0;
    for (std::uint32_t next = 0; next < tiling.count;) {
        const std::uint32_t end = std::min(next + work.units(), tiling.count);
        double seconds = 0.0;
        for (std::uint32_t place = next; place < end; ++place) {
            const std::uint32_t tile = tileAt(tiling.order, place);
            const std::uint32_t row = tile / 160;
            seconds += cost((tile % 160 + 0.5) / 160, (row + 0.5) / 90);
        }
        work.finished(seconds * work.units() / (end - next));
        longest = std::max(longest, seconds / WorkSize::kTargetSeconds);
        next = end;
    }
    return longest;
}

// A sky above tiles that take 20, 100 or 200 times as long, or around an object that does, on slow and fast
// devices.
TEST(TileOrder, noSubmissionIsLongWhereCostsStep) {
    for (const double cheap : {2e-5, 1e-4, 3e-4}) {
        for (const double ratio : {20.0, 100.0, 200.0}) {
            const auto ground = [&](double, const double y) { return y < 0.6 ? cheap : cheap * ratio; };
            const auto object = [&](const double x, const double y) {
                return std::hypot(x - 0.7, y - 0.5) < 0.1 ? cheap * ratio : cheap;
            };
            EXPECT_LE(longestSubmission(ground), 4.0) << cheap << ", 1:" << ratio;
            EXPECT_LE(longestSubmission(object), 4.0) << cheap << ", 1:" << ratio;
        }
    }
}

} // namespace
} // namespace metamarch::render
