// SPDX-License-Identifier: MIT
#include "fixtures/vulkan_environment.h"
#include "metamarch/viewer/magnifier.h"
#include "metamarch/vulkan/transfer.h"

#include <gtest/gtest.h>

#include <numeric>
#include <span>
#include <vector>

namespace metamarch::viewer {
namespace {

TEST(Magnifier, showsBlocksOfTheScreensPixels) {
    constexpr glm::uvec2 kScreen{101, 37}; // wider than a workgroup, and no multiple of a block
    const vulkan::Device& device = vulkan::testDevice();
    std::vector<std::uint32_t> pixels(std::size_t{kScreen.x} * kScreen.y);
    std::iota(pixels.begin(), pixels.end(), 1u);
    const vulkan::Buffer screen = vulkan::upload(device, std::span(pixels), "screen");

    Magnifier magnifier(device);
    EXPECT_FALSE(magnifier.isReady(kScreen));
    magnifier.make(kScreen);
    EXPECT_TRUE(magnifier.isReady(kScreen));
    for (const auto& [times, place] : {std::pair(1, glm::vec2(20, 9)), std::pair(3, glm::vec2(100, 36))}) {
        PixelZoom zoom;
        zoom.zoom(times, place, kScreen);
        const vulkan::Buffer* shown = nullptr;
        vulkan::Submission(device).run([&](vulkan::Commands& commands) {
            shown =
                &magnifier.record(commands, {kScreen, screen, false, false, nullptr, glm::uvec2(0)}, zoom);
        });
        const auto found = vulkan::download<std::uint32_t>(device, *shown);
        for (std::uint32_t y = 0; y < kScreen.y; ++y) {
            for (std::uint32_t x = 0; x < kScreen.x; ++x) {
                const glm::uvec2 from(zoom.toPicture({x, y}));
                ASSERT_EQ(found[y * kScreen.x + x], pixels[from.y * kScreen.x + from.x]) << x << ", " << y;
            }
        }
    }
    EXPECT_EQ(vulkan::validationMessages(), 0u);
}

} // namespace
} // namespace metamarch::viewer
