// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace metamarch {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// from_chars does not take a plus sign, which text files have.
std::string_view withoutPlus(std::string_view word) {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

} // namespace

std::optional<double> parseNumber(std::string_view word) {
    word = withoutPlus(word);
    const char* end = word.data() + word.size();
    double number = 0.0;
    const auto [stop, failure] = std::from_chars(word.data(), end, number);
    if (stop != end || failure == std::errc::invalid_argument) {
        return std::nullopt;
    }
    if (failure == std::errc::result_out_of_range) {
        // from_chars does not say which. A number that is out of range as large has a positive exponent or
        // many digits before its point; one that is too small has a negative exponent or a point in front.
        const std::size_t exponent = word.find_first_of("eE");
        const bool isSmall = exponent != std::string_view::npos ? word.substr(exponent + 1).starts_with('-')
                                                                : word.find('.') != std::string_view::npos;
        number = isSmall ? 0.0 : std::numeric_limits<double>::infinity();
        return word.starts_with('-') ? -number : number;
    }
    return number;
}

std::optional<std::int64_t> parseInteger(std::string_view word) {
    word = withoutPlus(word);
    const char* end = word.data() + word.size();
    std::int64_t number = 0;
    const auto [stop, failure] = std::from_chars(word.data(), end, number);
    if (stop != end || failure != std::errc()) {
        return std::nullopt;
    }
    return number;
}

TextScanner::TextScanner(std::string_view text) : rest_(text) {
    if (constexpr std::string_view kMark = "\xef\xbb\xbf"; rest_.starts_with(kMark)) {
        rest_.remove_prefix(kMark.size());
    }
}

bool TextScanner::nextLine() {
    if (rest_.empty()) {
        line_ = {};
        return false;
    }
    line_ = rest_.substr(0, rest_.find_first_of("\r\n"));
    rest_.remove_prefix(line_.size());
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest_.size(), 1));
    ++lineNumber_;
    return true;
}

std::string_view TextScanner::nextWord() {
    line_.remove_prefix(std::min(line_.find_first_not_of(kBlanks), line_.size()));
    const std::string_view word = line_.substr(0, line_.find_first_of(kBlanks));
    line_.remove_prefix(word.size());
    return word;
}

std::string_view TextScanner::restOfLine() {
    const std::string_view rest = trimmed(line_);
    line_ = {};
    return rest;
}

void TextScanner::cutLineAt(char mark) { line_ = line_.substr(0, line_.find(mark)); }

} // namespace metamarch
