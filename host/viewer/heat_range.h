// SPDX-License-Identifier: MIT
// The range of a heat map that suits a picture.
#pragma once
#include <cstdint>
#include <span>

namespace metamarch::viewer {

// Returns which part of the range of heatColor() is enough for all but the hottest 0.5 % of the pixels; 1
// where it is too small. `pixels` are packed colours of a heat map.
float hottestPart(std::span<const std::uint32_t> pixels);

// Returns the number for the hottest colour of the next picture, `now` being that of `pixels`. It stays where
// the pixels reach the upper half of the colours, and is within 1 and kMostHeat.
inline constexpr float kMostHeat = 4096.0f;
float fittingHeat(std::span<const std::uint32_t> pixels, float now);

} // namespace metamarch::viewer
