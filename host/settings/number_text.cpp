// SPDX-License-Identifier: MIT
#include "metamarch/settings/number_text.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace metamarch {
namespace {

[[noreturn]] void refuse(const std::string& wanted) {
    throw Error(ErrorKind::invalidArgument, "give " + wanted);
}

// Returns the number that is the whole text. std::from_chars knows no leading +.
template <class Number>
std::optional<Number> numberIn(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
        text.remove_prefix(1);
    }
    Number number{};
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && stop == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// Returns the numbers between the separators, or none if one of them is no number.
template <class Number>
std::vector<Number> numbersIn(std::string_view text, const char separator) {
    std::vector<Number> numbers;
    while (true) {
        const std::string_view word = text.substr(0, text.find(separator));
        const std::optional<Number> number = numberIn<Number>(word);
        if (!number) {
            return {};
        }
        numbers.push_back(*number);
        if (word.size() == text.size()) {
            return numbers;
        }
        text.remove_prefix(word.size() + 1);
    }
}

bool areFinite(const std::vector<double>& numbers) {
    return std::ranges::all_of(numbers,
                               [](const double number) { return std::isfinite(static_cast<float>(number)); });
}

} // namespace

double parseNumber(const std::string& text, const NumberRange& range) {
    const std::optional<double> number = numberIn<double>(text);
    if (!number || !(*number >= range.least && *number <= range.most)) {
        refuse(range.wanted);
    }
    return *number;
}

float parseFloat(const std::string& text, const NumberRange& range) {
    const double number = parseNumber(text, range);
    const auto single = static_cast<float>(number);
    if (!(std::abs(single) <= std::numeric_limits<float>::max()) || (single == 0.0f) != (number == 0.0)) {
        refuse(range.wanted);
    }
    return single;
}

std::uint32_t parseCount(const std::string& text, const std::uint32_t least, const std::uint32_t most) {
    const std::optional<std::uint32_t> number = numberIn<std::uint32_t>(text);
    if (!number || *number < least || *number > most) {
        refuse(fmt::format("a whole number from {} to {}", least, most));
    }
    return *number;
}

glm::dvec3 parsePoint(const std::string& text) {
    const std::vector<double> numbers = numbersIn<double>(text, ',');
    if (numbers.size() != 3 || !areFinite(numbers)) {
        refuse("three numbers, x,y,z");
    }
    return {numbers[0], numbers[1], numbers[2]};
}

glm::dvec3 parseOneOrThree(const std::string& text) {
    const std::vector<double> numbers = numbersIn<double>(text, ',');
    if ((numbers.size() != 1 && numbers.size() != 3) || !areFinite(numbers)) {
        refuse("one number, or three with commas between");
    }
    return numbers.size() == 1 ? glm::dvec3(numbers[0]) : glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

glm::uvec2 parseSize(const std::string& text) {
    const std::vector<std::uint32_t> sides = numbersIn<std::uint32_t>(text, 'x');
    if (sides.size() != 2 || sides[0] == 0 || sides[1] == 0) {
        refuse("WIDTHxHEIGHT in pixels, both at least 1");
    }
    const std::uint64_t pixels = std::uint64_t{sides[0]} * sides[1];
    if (pixels > kMaxPixels) {
        throw Error(ErrorKind::outOfMemory,
                    fmt::format("{} pixels are over the limit of {}", pixels, kMaxPixels));
    }
    return {sides[0], sides[1]};
}

PixelRect parseRect(const std::string& text) {
    const std::vector<std::uint32_t> edges = numbersIn<std::uint32_t>(text, ',');
    if (edges.size() != 4 || edges[0] >= edges[2] || edges[1] >= edges[3]) {
        refuse("x0,y0,x1,y1 in pixels, with x0 < x1 and y0 < y1");
    }
    return {edges[0], edges[1], edges[2], edges[3]};
}

std::string shortestText(const std::function<std::string(int digits)>& textWith,
                         const std::function<bool(const std::string& text)>& readsBack) {
    for (int digits = 6; digits < std::numeric_limits<double>::max_digits10; ++digits) {
        std::string text = textWith(digits);
        if (readsBack(text)) {
            return text;
        }
    }
    return textWith(std::numeric_limits<double>::max_digits10);
}

} // namespace metamarch
