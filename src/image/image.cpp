// SPDX-License-Identifier: MIT
#include "metamarch/image/image.h"

#include <algorithm>

namespace metamarch {
namespace {

std::size_t pixelIndex(const Image& image, int x, int y, std::size_t channel) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    return pixel * image.channels.size() + channel;
}

} // namespace

Image::Image(int widthInPixels, int heightInPixels, std::vector<std::string> channelNames)
    : width(widthInPixels), height(heightInPixels), channels(std::move(channelNames)) {
    pixels.resize(pixelCount() * channels.size());
}

std::size_t Image::pixelCount() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

std::optional<std::size_t> Image::findChannel(std::string_view name) const {
    const auto found = std::find(channels.begin(), channels.end(), name);
    if (found == channels.end()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - channels.begin());
}

float& Image::at(int x, int y, std::size_t channel) { return pixels[pixelIndex(*this, x, y, channel)]; }

float Image::at(int x, int y, std::size_t channel) const { return pixels[pixelIndex(*this, x, y, channel)]; }

} // namespace metamarch
