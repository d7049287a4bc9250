// SPDX-License-Identifier: MIT
#include "metamarch/settings/number_list.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace metamarch {
namespace {

// Every number between `separator`s, or nothing when one of them is none.
template <class Number>
std::optional<std::vector<Number>> parseNumbers(std::string_view text, const char separator) {
    std::vector<Number> numbers;
    while (true) {
        const std::string_view word = text.substr(0, text.find(separator));
        Number number{};
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || stop != word.data() + word.size()) {
            return std::nullopt;
        }
        numbers.push_back(number);
        if (word.size() == text.size()) {
            return numbers;
        }
        text.remove_prefix(word.size() + 1);
    }
}

[[noreturn]] void refuse(const char* wanted) {
    throw Error(ErrorKind::invalidArgument, fmt::format("give {}", wanted));
}

bool allFinite(const std::vector<double>& numbers) {
    for (const double number : numbers) {
        // As positions are, in single precision.
        if (!std::isfinite(static_cast<float>(number))) {
            return false;
        }
    }
    return true;
}

} // namespace

glm::dvec3 parsePoint(const std::string& text) {
    const auto numbers = parseNumbers<double>(text, ',');
    if (!numbers || numbers->size() != 3 || !allFinite(*numbers)) {
        refuse("three numbers, x,y,z");
    }
    return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

glm::dvec3 parseOneOrThree(const std::string& text) {
    const auto numbers = parseNumbers<double>(text, ',');
    if (!numbers || (numbers->size() != 1 && numbers->size() != 3) || !allFinite(*numbers)) {
        refuse("one number, or three with commas between");
    }
    return numbers->size() == 1 ? glm::dvec3(numbers->front())
                                : glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

glm::uvec2 parseSize(const std::string& text) {
    const auto numbers = parseNumbers<std::uint32_t>(text, 'x');
    if (!numbers || numbers->size() != 2 || numbers->front() == 0 || numbers->back() == 0) {
        refuse("WIDTHxHEIGHT in pixels, both at least 1");
    }
    const std::uint64_t pixels = std::uint64_t{numbers->front()} * numbers->back();
    if (pixels > kMaxPixels) {
        throw Error(ErrorKind::outOfMemory,
                    fmt::format("{} pixels are over the limit of {}", pixels, kMaxPixels));
    }
    return {numbers->front(), numbers->back()};
}

} // namespace metamarch
