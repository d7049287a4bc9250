// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace metamarch {
namespace {

constexpr bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && isBlank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

// from_chars does not take a plus sign, which text files have.
std::string_view withoutPlus(std::string_view word) {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

// Older C libraries of Microsoft print "1.#QNAN", "-1.#IND" and "1.#INF", and behind it zeros up to the
// precision and an exponent.
std::optional<double> parseMicrosoft(std::string_view word) {
    constexpr std::string_view kBegin = "1.#";
    const bool isNegative = word.starts_with('-');
    word.remove_prefix(isNegative ? 1 : 0);
    if (!word.starts_with(kBegin)) {
        return std::nullopt;
    }
    word.remove_prefix(kBegin.size());
    for (const std::string_view name : {"INF", "QNAN", "SNAN", "IND"}) {
        if (word.starts_with(name) &&
            word.find_first_not_of("0123456789eE+-", name.size()) == std::string_view::npos) {
            const double number = name == "INF" ? std::numeric_limits<double>::infinity()
                                                : std::numeric_limits<double>::quiet_NaN();
            return isNegative ? -number : number;
        }
    }
    return std::nullopt;
}

// Whether the '#' at `mark` belongs to a number of parseMicrosoft.
bool isOfNumber(std::string_view line, std::size_t mark) {
    constexpr std::string_view kBefore = "1.";
    if (!line.substr(0, mark).ends_with(kBefore)) {
        return false;
    }
    std::size_t begin = mark - kBefore.size();
    if (begin > 0 && (line[begin - 1] == '-' || line[begin - 1] == '+')) {
        --begin;
    }
    if (begin > 0 && !isBlank(line[begin - 1])) {
        return false;
    }
    std::size_t end = mark + 1;
    while (end < line.size() && !isBlank(line[end]) && line[end] != '#' && line[end] != '\\') {
        ++end;
    }
    return parseNumber(line.substr(begin, end - begin)).has_value();
}

} // namespace

std::optional<double> parseNumber(std::string_view word) {
    word = withoutPlus(word);
    // Most words of a mesh are small indices.
    if (!word.empty() && word.size() < 10 && std::ranges::all_of(word, isDigit)) {
        std::uint32_t number = 0;
        for (const char digit : word) {
            number = 10 * number + static_cast<std::uint32_t>(digit - '0');
        }
        return number;
    }
    const char* end = word.data() + word.size();
    double number = 0.0;
    const auto [stop, failure] = std::from_chars(word.data(), end, number);
    if (stop != end || failure == std::errc::invalid_argument) {
        return parseMicrosoft(word);
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

std::string_view beforeComment(std::string_view line) {
    std::size_t mark = line.find('#');
    while (mark != std::string_view::npos && isOfNumber(line, mark)) {
        mark = line.find('#', mark + 1);
    }
    return line.substr(0, mark);
}

std::string_view withJoinedLines(std::string_view text, std::string& copy) {
    if (text.find('\\') == std::string_view::npos) {
        return text;
    }
    copy.clear();
    copy.reserve(text.size());
    std::size_t missing = 0; // line ends that the current line has lost
    while (!text.empty()) {
        const std::size_t size = std::min(text.find_first_of("\r\n"), text.size());
        const std::string_view line = text.substr(0, size);
        const std::string_view after = text.substr(size);
        const std::string_view end = after.substr(0, after.starts_with("\r\n") ? 2 : 1);
        const std::string_view content = trimmed(line);
        if (content.ends_with('\\') && !end.empty() && beforeComment(line).size() == line.size()) {
            copy.append(content.substr(0, content.size() - 1)) += ' ';
            ++missing;
        } else {
            copy.append(line).append(missing, '\n').append(end);
            missing = 0;
        }
        text = after.substr(end.size());
    }
    return copy;
}

std::string inQuotes(std::string_view word) {
    constexpr std::size_t kMost = 40;
    return '\'' + std::string(word.substr(0, kMost)) + (word.size() > kMost ? "...'" : "'");
}

TextScanner::TextScanner(std::string_view text, Comments comments) : comments_(comments), rest_(text) {
    if (constexpr std::string_view kMark = "\xef\xbb\xbf"; rest_.starts_with(kMark)) {
        rest_.remove_prefix(kMark.size());
    }
}

bool TextScanner::nextLine() {
    if (rest_.empty()) {
        line_ = {};
        return false;
    }
    const char* begin = rest_.data();
    const char* end = begin + rest_.size();
    // A text whose lines end at \r alone is not searched for \n again at each line.
    if (newline_ == nullptr || newline_ < begin) {
        const void* found = std::memchr(begin, '\n', rest_.size());
        newline_ = found == nullptr ? end : static_cast<const char*>(found);
    }
    const void* found = std::memchr(begin, '\r', static_cast<std::size_t>(newline_ - begin));
    const char* stop = found == nullptr ? newline_ : static_cast<const char*>(found);
    line_ = std::string_view(begin, static_cast<std::size_t>(stop - begin));
    rest_.remove_prefix(line_.size());
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest_.size(), 1));
    ++lineNumber_;
    if (comments_ == Comments::cut) {
        cutComment();
    }
    return true;
}

std::string_view TextScanner::nextWord() {
    const char* begin = line_.data();
    const char* const end = begin + line_.size();
    while (begin != end && isBlank(*begin)) {
        ++begin;
    }
    const char* stop = begin;
    while (stop != end && !isBlank(*stop)) {
        ++stop;
    }
    line_ = std::string_view(stop, static_cast<std::size_t>(end - stop));
    return {begin, static_cast<std::size_t>(stop - begin)};
}

std::string_view TextScanner::wordOfLaterLine() {
    while (nextLine()) {
        if (const std::string_view word = nextWord(); !word.empty()) {
            return word;
        }
    }
    return {};
}

std::string_view TextScanner::nextWordOverLines() {
    const std::string_view word = nextWord();
    return word.empty() ? wordOfLaterLine() : word;
}

std::string_view TextScanner::restOfLine() {
    const std::string_view rest = trimmed(line_);
    line_ = {};
    return rest;
}

void TextScanner::cutComment() { line_ = beforeComment(line_); }

} // namespace metamarch
