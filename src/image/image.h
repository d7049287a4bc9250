// SPDX-License-Identifier: MIT
// A picture in memory, with any number of named 32-bit float channels.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace metamarch {

struct Image {
    Image() = default;
    // All pixels start as 0.
    Image(int widthInPixels, int heightInPixels, std::vector<std::string> channelNames);

    std::size_t pixelCount() const;
    std::optional<std::size_t> findChannel(std::string_view name) const;

    // `x` counts from the left, `y` from the top.
    float& at(int x, int y, std::size_t channel);
    float at(int x, int y, std::size_t channel) const;

    int width = 0;
    int height = 0;
    std::vector<std::string> channels;
    std::vector<float> pixels; // interleaved, row 0 is the top one
    std::vector<std::pair<std::string, std::string>> attributes;
};

} // namespace metamarch
