// SPDX-License-Identifier: MIT
#include "metamarch/image/image.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace metamarch {
namespace {

std::size_t pixelIndex(const Image& image, int x, int y, std::size_t channel) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    return pixel * image.channels.size() + channel;
}

std::optional<std::size_t> find(const std::vector<std::string>& names, const std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - names.begin());
}

// Puts the values of each pixel of `b` behind those of `a`.
template <class T>
std::vector<T> interleaved(const std::vector<T>& a, const std::vector<T>& b, const std::size_t pixels) {
    std::vector<T> both;
    both.reserve(a.size() + b.size());
    const auto append = [&](const std::vector<T>& values, const std::size_t pixel) {
        const std::size_t ofPixel = values.size() / pixels;
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(pixel * ofPixel);
        both.insert(both.end(), first, first + static_cast<std::ptrdiff_t>(ofPixel));
    };
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        append(a, pixel);
        append(b, pixel);
    }
    return both;
}

} // namespace

Image::Image(int widthInPixels, int heightInPixels, std::vector<std::string> channelNames,
             std::vector<std::string> idChannelNames)
    : width(widthInPixels), height(heightInPixels), channels(std::move(channelNames)),
      idChannels(std::move(idChannelNames)) {
    pixels.resize(pixelCount() * channels.size());
    ids.resize(pixelCount() * idChannels.size());
}

std::size_t Image::pixelCount() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

std::optional<std::size_t> Image::findChannel(std::string_view name) const { return find(channels, name); }

std::optional<std::size_t> Image::findIdChannel(std::string_view name) const {
    return find(idChannels, name);
}

void Image::append(const Image& other) {
    pixels = interleaved(pixels, other.pixels, pixelCount());
    ids = interleaved(ids, other.ids, pixelCount());
    channels.insert(channels.end(), other.channels.begin(), other.channels.end());
    idChannels.insert(idChannels.end(), other.idChannels.begin(), other.idChannels.end());
}

float& Image::at(int x, int y, std::size_t channel) { return pixels[pixelIndex(*this, x, y, channel)]; }

float Image::at(int x, int y, std::size_t channel) const { return pixels[pixelIndex(*this, x, y, channel)]; }

std::vector<glm::vec3> colorsIn(const Image& image, const std::string_view first) {
    const std::size_t channel = image.findChannel(first).value();
    std::vector<glm::vec3> colors(image.pixelCount());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        colors[i] = glm::make_vec3(&image.pixels[i * image.channels.size() + channel]);
    }
    return colors;
}

} // namespace metamarch
