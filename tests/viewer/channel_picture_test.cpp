// SPDX-License-Identifier: MIT
// Channels of a film as colours.
#include "metamarch/shared/false_color.h"
#include "metamarch/viewer/channel_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamarch::viewer {
namespace {

// Two pixels of one sample each: a hit at t 2, and a miss.
FilmData film() {
    FilmData made(2, 0);
    FirstHit hit = missFirst();
    hit.triangleId = 7;
    hit.t = 2.0f;
    hit.depth = 2.0f;
    hit.normal = {0.0f, 0.0f, 1.0f};
    hit.albedo = {1.0f, 0.0f, 0.0f};
    made.pixels[0] = addSample(emptyPixel(), glm::vec3(0.5f), hit);
    made.pixels[1] = addSample(emptyPixel(), glm::vec3(0.0f), missFirst());
    return made;
}

std::vector<std::uint32_t> pixelsOf(const std::string& name) {
    return channelPixels(aovNamed(name), film(), {}, {});
}

TEST(ChannelPicture, isAColourOfTheValue) {
    EXPECT_EQ(pixelsOf("albedo")[0], packedPixel({1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(pixelsOf("N")[0], packedPixel({0.5f, 0.5f, 1.0f}));
    EXPECT_EQ(pixelsOf("id.triangle")[0], packedLinear(idColor(7)));
    EXPECT_EQ(pixelsOf("id.triangle")[1], packedPixel(glm::vec3(0.0f)));
    EXPECT_EQ(pixelsOf("Z")[1], packedPixel(heatColor(0.0f))); // one finite depth is no range
}

TEST(ChannelPicture, isOfferedIfTheFilmSuffices) {
    for (const Aov& channel : shownChannels()) {
        EXPECT_EQ(channel.filmParts, 0u) << channel.names;
        EXPECT_TRUE(channel.value != nullptr || channel.id != nullptr) << channel.names;
        EXPECT_EQ(channelPixels(channel, film(), {}, {}).size(), 2u) << channel.names;
    }
    EXPECT_TRUE(
        std::ranges::any_of(shownChannels(), [](const Aov& channel) { return channel.name() == "P"; }));
}

} // namespace
} // namespace metamarch::viewer
