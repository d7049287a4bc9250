// SPDX-License-Identifier: MIT
// A picture in memory, with any number of named channels: 32-bit floats, and whole numbers.
#pragma once
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace metamarch {

// A matrix transforms column vectors.
using ImageAttribute = std::variant<std::string, int, float, glm::mat4>;

struct Image {
    Image() = default;
    // All pixels start as 0.
    Image(int widthInPixels, int heightInPixels, std::vector<std::string> channelNames,
          std::vector<std::string> idChannelNames = {});

    std::size_t pixelCount() const;
    std::optional<std::size_t> findChannel(std::string_view name) const;
    std::optional<std::size_t> findIdChannel(std::string_view name) const;

    // `x` counts from the left, `y` from the top.
    float& at(int x, int y, std::size_t channel);
    float at(int x, int y, std::size_t channel) const;

    // Adds the channels of a picture of the same size, but not its attributes.
    void append(const Image& other);

    int width = 0;
    int height = 0;
    // Where the pixels lie in a larger picture, whose size is fullWidth x fullHeight; 0: this is the whole.
    int left = 0;
    int top = 0;
    int fullWidth = 0;
    int fullHeight = 0;
    std::vector<std::string> channels;
    std::vector<float> pixels; // interleaved, row 0 is the top one
    std::vector<std::string> idChannels;
    std::vector<std::uint32_t> ids; // likewise, of the channels of whole numbers
    std::vector<std::pair<std::string, ImageAttribute>> attributes;
};

// Returns the colours in the channel `first` and the two that follow it.
std::vector<glm::vec3> colorsIn(const Image& image, std::string_view first);

} // namespace metamarch
