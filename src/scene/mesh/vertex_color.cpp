// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/vertex_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace metamarch {
namespace {

// IEC 61966-2-1
float linear(double encoded) {
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

std::array<float, 256> linearBytes() {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = linear(static_cast<double>(i) / 255.0);
    }
    return values;
}

// Returns the number that means 1. Some programs write fractions up to 255.
float fullColor(bool areFractions, float largest) {
    if (areFractions && largest <= kLargestFraction) {
        return 1.0f;
    }
    return areFractions || largest <= 255.0f ? 255.0f : 65535.0f;
}

} // namespace

void FileColors::add(const glm::vec3& color, std::optional<float> alpha) {
    for (int channel = 0; channel < 3; ++channel) {
        largest_ = std::max(largest_, color[channel]); // a NaN is not larger
    }
    // Alpha is kept negative until its full value is known.
    colors_.emplace_back(color, alpha.value_or(-1.0f));
    largestAlpha_ = std::max(largestAlpha_, alpha.value_or(0.0f));
}

std::vector<glm::vec4> FileColors::decoded() {
    static const std::array<float, 256> kLinearBytes = linearBytes();
    const float full = fullColor(areFractions_, largest_);
    // No program writes an alpha of 1 / 255 everywhere, but some write fractions behind whole numbers.
    const float fullAlpha = largestAlpha_ <= kLargestFraction ? 1.0f : std::max(full, 255.0f);
    for (glm::vec4& color : colors_) {
        for (int channel = 0; channel < 3; ++channel) {
            float& value = color[channel];
            value = full == 1.0f ? std::min(value, 1.0f) : value; // keeps a NaN
            const bool isByte =
                full == 255.0f && value >= 0.0f && value <= 255.0f && value == std::floor(value);
            value = isByte ? kLinearBytes[static_cast<std::size_t>(value)]
                           : linear(static_cast<double>(value) / static_cast<double>(full));
        }
        color.a = color.a < 0.0f ? 1.0f : std::min(color.a / fullAlpha, 1.0f);
    }
    return std::move(colors_);
}

Material vertexColorMaterial(const std::vector<glm::vec4>& colors) {
    Material material;
    material.metallicFactor = 0.0f;
    material.doubleSided = true;
    const auto isClear = [](const glm::vec4& color) { return color.a < 1.0f; };
    const auto isAbsent = [](const glm::vec4& color) { return color.a == 0.0f; };
    if (std::ranges::any_of(colors, isClear) && !std::ranges::all_of(colors, isAbsent)) {
        material.alphaMode = AlphaMode::blend;
    }
    return material;
}

} // namespace metamarch
