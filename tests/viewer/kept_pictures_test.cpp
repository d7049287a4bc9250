// SPDX-License-Identifier: MIT
#include "fixtures/vulkan_environment.h"
#include "metamarch/viewer/kept_pictures.h"
#include "metamarch/vulkan/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

namespace metamarch::viewer {
namespace {

constexpr glm::uvec2 kBefore{8, 6};
constexpr glm::uvec2 kNow{5, 9};
constexpr std::uint32_t kRed = 0xff0000ffu;

// A frame of the present picture, which is red, and what is kept of it.
void paintRed(KeptPictures& kept, const Shown shown) {
    const vulkan::Device& device = vulkan::testDevice();
    const std::vector<std::uint32_t> pixels(std::size_t{kNow.x} * kNow.y, kRed);
    vulkan::Buffer screen(device, vulkan::BufferUse::storage, pixels.size() * sizeof(std::uint32_t),
                          "screen");
    vulkan::write(device, screen, 0, std::as_bytes(std::span(pixels)));
    vulkan::Submission(device).run([&](vulkan::Commands& commands) {
        kept.paint(commands, {kNow, screen, false, false, nullptr, glm::uvec2(0)}, shown);
    });
}

TEST(KeptPictures, followAWindowWhoseSizeChangesBeforeTheFrame) {
    KeptPictures kept(vulkan::testDevice());
    kept.keep(Shown::a, kBefore);
    EXPECT_FALSE(kept.has(Shown::a));
    kept.follow(kNow);
    paintRed(kept, Shown::present);
    ASSERT_TRUE(kept.has(Shown::a));
    EXPECT_FALSE(kept.has(Shown::b));
    const KeptPictures::Picture picture = kept.picture(Shown::a);
    EXPECT_EQ(picture.size, kNow);
    EXPECT_EQ(std::ranges::count(picture.pixels, kRed), std::ptrdiff_t{kNow.x} * kNow.y);

    kept.follow(kBefore); // what is kept stays as it is
    EXPECT_EQ(kept.picture(Shown::a).size, kNow);
    kept.forget();
    EXPECT_FALSE(kept.has(Shown::a));
    EXPECT_EQ(vulkan::validationMessages(), 0u);
}

} // namespace
} // namespace metamarch::viewer
