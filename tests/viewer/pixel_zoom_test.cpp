// SPDX-License-Identifier: MIT
#include "metamarch/viewer/pixel_zoom.h"

#include <gtest/gtest.h>

namespace metamarch::viewer {
namespace {

constexpr glm::uvec2 kSize{100, 60};

TEST(PixelZoom, keepsWhatLiesUnderTheCursor) {
    PixelZoom zoom;
    EXPECT_FALSE(zoom.isOn());
    const glm::vec2 cursor(33.0f, 21.0f);
    for (const int times : {1, 2, -1, 4}) {
        zoom.zoom(times, cursor, kSize);
        EXPECT_EQ(glm::uvec2(zoom.toPicture(cursor)), glm::uvec2(cursor)) << zoom.scale();
        EXPECT_EQ(zoom.toWindow(zoom.toPicture({5.0f, 7.0f})), glm::vec2(5.0f, 7.0f));
    }
    EXPECT_EQ(zoom.scale(), 64u);
    zoom.zoom(1, cursor, kSize);
    EXPECT_EQ(zoom.scale(), PixelZoom::kMost);
    zoom.zoom(-100, cursor, kSize);
    EXPECT_FALSE(zoom.isOn());
    EXPECT_EQ(zoom.skipped(), glm::uvec2(0));
}

TEST(PixelZoom, addsUpThePartsOfClicks) {
    PixelZoom zoom;
    for (const std::uint32_t scale : {1u, 1u, 1u, 2u, 2u, 2u, 2u, 4u}) {
        zoom.scroll(0.25f, {0.0f, 0.0f}, kSize);
        EXPECT_EQ(zoom.scale(), scale);
    }
    zoom.scroll(-0.75f, {0.0f, 0.0f}, kSize);
    EXPECT_EQ(zoom.scale(), 4u);
    zoom.scroll(-1.25f, {0.0f, 0.0f}, kSize);
    EXPECT_EQ(zoom.scale(), 1u);
}

TEST(PixelZoom, staysWithinThePicture) {
    PixelZoom zoom;
    zoom.zoom(2, {0.0f, 0.0f}, kSize);
    zoom.move({-7.0f, -9.0f}, kSize);
    EXPECT_EQ(zoom.skipped(), glm::uvec2(7, 9));
    zoom.move({1000.0f, 4.0f}, kSize);
    EXPECT_EQ(zoom.skipped(), glm::uvec2(0, 5));
    zoom.move({-1000.0f, -1000.0f}, kSize);
    EXPECT_EQ(zoom.toPicture(glm::vec2(kSize)), glm::vec2(kSize)); // the corners meet
    zoom.follow({40, 30});
    EXPECT_EQ(zoom.toPicture({40.0f, 30.0f}), glm::vec2(40.0f, 30.0f));
}

} // namespace
} // namespace metamarch::viewer
