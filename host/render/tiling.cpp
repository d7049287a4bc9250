// SPDX-License-Identifier: MIT
#include "metamarch/render/tiling.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace metamarch::render {
namespace {

// Returns the first number at or above `count` divided by the golden ratio that has no divisor in common with
// `count`. Its multiples modulo `count` are all numbers below `count`; those of the golden ratio are spread
// evenly.
std::uint32_t evenStride(const std::uint32_t count) {
    auto stride = static_cast<std::uint32_t>(std::lround(count / std::numbers::phi));
    while (std::gcd(stride, count) != 1) {
        ++stride;
    }
    return stride;
}

TileOrder orderOf(const PixelRect& area) {
    const std::uint32_t perRow = (area.width() + kTileSide - 1) / kTileSide;
    const std::uint32_t rows = (area.height() + kTileSide - 1) / kTileSide;
    return {perRow, rows, evenStride(rows), evenStride(perRow)};
}

} // namespace

Tiling::Tiling(const Camera& camera) : Tiling(PixelRect{0, 0, camera.width, camera.height}) {}

Tiling::Tiling(const PixelRect& area)
    : size(area.width(), area.height()), order(orderOf(area)), count(order.perRow * order.rows) {}

} // namespace metamarch::render
