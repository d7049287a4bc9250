// SPDX-License-Identifier: MIT
// Splits the text of a mesh file into lines, words and numbers.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace metamarch {

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Returns the number that is the whole word, or nothing. Forms such as "+1", ".5", "1." and "1e3" are
// numbers, and so are "inf" and "nan" in any case, and "1.#INF". A number too large for a double is infinite,
// one too small is zero.
std::optional<double> parseNumber(std::string_view word);
std::optional<std::int64_t> parseInteger(std::string_view word);

// Returns what stands before the first '#', which starts a comment. The '#' of "1.#INF" and its like does
// not.
std::string_view beforeComment(std::string_view line);

// Returns `text`, in which a backslash at the end of a line, or with blanks behind it there, joins the next
// line; nothing is joined in comments. Lines keep their numbers: as many empty ones follow a joined line.
// `copy` holds the text if lines had to be joined.
std::string_view withJoinedLines(std::string_view text, std::string& copy);

// Returns 'word' for a message, without what is behind its first 40 characters.
std::string inQuotes(std::string_view word);

// A line ends at \n, \r\n or \r, or where the text ends. Blanks are spaces, tabs, \v and \f. A byte order
// mark before the first line is skipped.
class TextScanner {
  public:
    enum class Comments { keep, cut };

    explicit TextScanner(std::string_view text, Comments comments = Comments::keep);

    // Goes to the next line. Returns false where the text ends.
    bool nextLine();

    // Returns the next word of the line, or nothing where the line ends.
    std::string_view nextWord();

    // Returns the first word of the next line that has one, or nothing where the text ends.
    std::string_view wordOfLaterLine();

    // Returns the next word of this line or of a later one, or nothing where the text ends.
    std::string_view nextWordOverLines();

    // Returns what is left of the line, without blanks around it.
    std::string_view restOfLine();

    // Cuts the line where a comment begins.
    void cutComment();

    std::uint64_t lineNumber() const { return lineNumber_; } // 1 is the first line

    // What follows the line and its end.
    std::string_view rest() const { return rest_; }

    // Returns the bytes from `word`, which this scanner has returned, to the end of the text.
    std::size_t bytesFrom(std::string_view word) const {
        return static_cast<std::size_t>(rest_.data() + rest_.size() - word.data());
    }

  private:
    Comments comments_;
    std::string_view rest_;
    std::string_view line_;
    const char* newline_ = nullptr; // the next \n, or where the text ends, as soon as it has been looked for
    std::uint64_t lineNumber_ = 0;
};

} // namespace metamarch
