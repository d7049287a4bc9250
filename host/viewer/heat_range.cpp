// SPDX-License-Identifier: MIT
#include "metamarch/viewer/heat_range.h"

#include "metamarch/shared/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace metamarch::viewer {
namespace {

constexpr std::size_t kColors = 256;
constexpr std::size_t kMostLookedAt = 5'000; // pixels
constexpr float kLeftOut = 0.005f;           // of the pixels

std::array<std::uint32_t, kColors> heatColors() {
    std::array<std::uint32_t, kColors> colors{};
    for (std::size_t i = 0; i < kColors; ++i) {
        colors[i] = packedPixel(heatColor(static_cast<float>(i) / (kColors - 1)));
    }
    return colors;
}

int distanceOf(const std::uint32_t a, const std::uint32_t b) {
    int sum = 0;
    for (const unsigned shift : {0u, 8u, 16u}) {
        sum += std::abs(static_cast<int>((a >> shift) & 255u) - static_cast<int>((b >> shift) & 255u));
    }
    return sum;
}

} // namespace

float hottestPart(const std::span<const std::uint32_t> pixels) {
    static const std::array<std::uint32_t, kColors> kHeat = heatColors();
    const std::size_t stride = pixels.size() / kMostLookedAt + 1;
    std::array<std::size_t, kColors> counts{};
    std::size_t all = 0;
    for (std::size_t i = 0; i < pixels.size(); i += stride, ++all) {
        const auto nearest = std::ranges::min_element(
            kHeat, {}, [&](const std::uint32_t color) { return distanceOf(color, pixels[i]); });
        ++counts[static_cast<std::size_t>(nearest - kHeat.begin())];
    }
    const auto most = static_cast<std::size_t>(kLeftOut * static_cast<float>(all));
    std::size_t hotter = 0;
    std::size_t color = kColors - 1;
    while (color > 0 && (hotter += counts[color]) <= most) {
        --color;
    }
    return static_cast<float>(color) / (kColors - 1);
}

float fittingHeat(const std::span<const std::uint32_t> pixels, const float now) {
    constexpr float kRoom = 1.1f; // so that the hottest pixel is not taken for one beyond the range
    const float part = hottestPart(pixels);
    const float next = part >= 1.0f ? 2.0f * now : part < 0.5f ? std::ceil(now * part * kRoom) + 1.0f : now;
    return std::clamp(next, 1.0f, kMostHeat);
}

} // namespace metamarch::viewer
