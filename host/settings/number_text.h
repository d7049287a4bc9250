// SPDX-License-Identifier: MIT
// Reads the numbers in the text of a setting. Every function throws Error(invalidArgument), saying what to
// give instead: "give a finite number". A leading + is allowed.
#pragma once
#include "metamarch/shared/film_data.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace metamarch {

// The values that a number may have, both ends included. `wanted` describes them in messages: "degrees
// between 0 and 180". NaN is in no range.
struct NumberRange {
    double least = -std::numeric_limits<double>::max();
    double most = std::numeric_limits<double>::max();
    std::string wanted = "a finite number";
};

double parseNumber(const std::string& text, const NumberRange& range);

// Refuses a number that overflows in single precision, or that rounds to 0 there.
float parseFloat(const std::string& text, const NumberRange& range);

// Reads a whole number in [least, most].
std::uint32_t parseCount(const std::string& text, std::uint32_t least, std::uint32_t most);

// Reads "x,y,z": three numbers that are finite in single precision.
glm::dvec3 parsePoint(const std::string& text);

// Reads "U" for all three axes, or "Ux,Uy,Uz". The numbers are finite in single precision.
glm::dvec3 parseOneOrThree(const std::string& text);

// Reads "WxH", both at least 1. Throws Error(outOfMemory) for a picture of more than kMaxPixels.
glm::uvec2 parseSize(const std::string& text);

// "x0,y0,x1,y1": the pixels [x0, x1) x [y0, y1), at least one.
PixelRect parseRect(const std::string& text);

// Returns the first of textWith(6), textWith(7), ..., textWith(17) that the setting reads back as the value
// it has. The user sees such values in other units, whose decimals do not round as the value does.
std::string shortestText(const std::function<std::string(int digits)>& textWith,
                         const std::function<bool(const std::string& text)>& readsBack);

// The largest picture. A pixel takes about 100 bytes while the picture is rendered and written.
inline constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 27u;

} // namespace metamarch
