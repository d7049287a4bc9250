// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/text_scanner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace metamarch {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(TextScanner, NumbersInEveryForm) {
    EXPECT_EQ(parseNumber("12"), 12.0);
    EXPECT_EQ(parseNumber("+1"), 1.0);
    EXPECT_EQ(parseNumber(".5"), 0.5);
    EXPECT_EQ(parseNumber("-.5"), -0.5);
    EXPECT_EQ(parseNumber("1."), 1.0);
    EXPECT_EQ(parseNumber("1e3"), 1000.0);
    EXPECT_EQ(parseNumber("+1.5E-1"), 0.15);
    EXPECT_EQ(parseNumber("999999999"), 999999999.0);
    EXPECT_EQ(parseNumber("12345678901234567890"), 12345678901234567890.0);
    EXPECT_EQ(parseNumber("000000000000000000001"), 1.0);
    EXPECT_TRUE(std::signbit(*parseNumber("-0")));
}

TEST(TextScanner, NumbersThatAreNotFinite) {
    EXPECT_EQ(parseNumber("1e400"), kInfinity);
    EXPECT_EQ(parseNumber("-1e400"), -kInfinity);
    EXPECT_EQ(parseNumber("1e-400"), 0.0);
    EXPECT_EQ(parseNumber("0." + std::string(400, '0') + "1"), 0.0);
    EXPECT_EQ(parseNumber(std::string(400, '9')), kInfinity);
    EXPECT_EQ(parseNumber("INF"), kInfinity);
    EXPECT_EQ(parseNumber("-inf"), -kInfinity);
    EXPECT_EQ(parseNumber("-1.#INF"), -kInfinity);
    for (const char* word :
         {"nan", "NaN", "-nan(ind)", "1.#QNAN", "+1.#SNAN", "-1.#IND000", "1.#QNAN0e+000"}) {
        EXPECT_TRUE(parseNumber(word) && std::isnan(*parseNumber(word))) << word;
    }
}

TEST(TextScanner, WordsThatAreNoNumbers) {
    for (const char* word :
         {"", "+", "-", "+-1", "1,5", "0x10", "1 ", "one", "1.#", "1.#INFO", "2.#INF", "--1", "."}) {
        EXPECT_FALSE(parseNumber(word)) << word;
    }
    EXPECT_EQ(parseInteger("-12"), -12);
    EXPECT_EQ(parseInteger("+12"), 12);
    EXPECT_FALSE(parseInteger("1.0"));
    EXPECT_FALSE(parseInteger("99999999999999999999"));
}

TEST(TextScanner, LinesEndInEveryWay) {
    TextScanner scanner("\xef\xbb\xbfone two\r\n\rthree\n\nfour");
    std::vector<std::string> lines;
    while (scanner.nextLine()) {
        lines.emplace_back(scanner.restOfLine());
    }
    EXPECT_EQ(lines, std::vector<std::string>({"one two", "", "three", "", "four"}));
    EXPECT_EQ(scanner.lineNumber(), 5u);
    EXPECT_FALSE(scanner.nextLine());
}

TEST(TextScanner, WordsAndComments) {
    TextScanner scanner("\t a \v b c # d\n# e\n f ");
    EXPECT_EQ(scanner.nextWord(), ""); // before the first line
    scanner.nextLine();
    scanner.cutComment();
    EXPECT_EQ(scanner.nextWord(), "a");
    EXPECT_EQ(scanner.restOfLine(), "b c");
    EXPECT_EQ(scanner.nextWord(), "");
    EXPECT_EQ(scanner.rest(), "# e\n f ");
    scanner.nextLine();
    scanner.cutComment();
    EXPECT_EQ(scanner.nextWord(), "");
    scanner.nextLine();
    EXPECT_EQ(scanner.nextWord(), "f");
    EXPECT_EQ(scanner.nextWord(), "");
}

TEST(TextScanner, WordsOverLines) {
    const std::string_view text = "a b\n# c\n\n d # e\nf\n ";
    TextScanner scanner(text, TextScanner::Comments::cut);
    EXPECT_EQ(scanner.nextWordOverLines(), "a");
    EXPECT_EQ(scanner.nextWordOverLines(), "b");
    const std::string_view d = scanner.nextWordOverLines();
    EXPECT_EQ(d, "d");
    EXPECT_EQ(scanner.bytesFrom(d), 9u);
    EXPECT_EQ(scanner.nextWord(), "");
    EXPECT_EQ(scanner.wordOfLaterLine(), "f");
    EXPECT_EQ(scanner.wordOfLaterLine(), "");
    TextScanner kept(text);
    EXPECT_EQ(kept.wordOfLaterLine(), "a");
    EXPECT_EQ(kept.wordOfLaterLine(), "#");
}

TEST(TextScanner, CommentsBeginAtAMarkThatIsOfNoNumber) {
    EXPECT_EQ(beforeComment("v 0 1 2"), "v 0 1 2");
    EXPECT_EQ(beforeComment("v 0 1 2# two"), "v 0 1 2");
    EXPECT_EQ(beforeComment("v 0 1 1.#one"), "v 0 1 1.");
    EXPECT_EQ(beforeComment("v 0 1 1.#INFORMATION"), "v 0 1 1.");
    EXPECT_EQ(beforeComment("v 0 1 21.#INF"), "v 0 1 21.");
    EXPECT_EQ(beforeComment("1.#INF\t-1.#IND00 +1.#QNAN# 1.#INF"), "1.#INF\t-1.#IND00 +1.#QNAN");
}

TEST(TextScanner, BackslashesJoinLines) {
    std::string copy;
    EXPECT_EQ(withJoinedLines("a\nb", copy), "a\nb");
    EXPECT_EQ(withJoinedLines("a \\\n b\nc", copy), "a   b\n\nc");
    EXPECT_EQ(withJoinedLines("a\\ \t\r\nb\\\rc\r\nd", copy), "a b c\n\n\r\nd");
    EXPECT_EQ(withJoinedLines("a\\b\nc", copy), "a\\b\nc");
    EXPECT_EQ(withJoinedLines("a # b\\\nc", copy), "a # b\\\nc");
    EXPECT_EQ(withJoinedLines("1.#INF\\\n2", copy), "1.#INF 2\n");
    EXPECT_EQ(withJoinedLines("a\\", copy), "a\\"); // there is no next line
}

TEST(TextScanner, QuotesAreShort) {
    EXPECT_EQ(inQuotes("word"), "'word'");
    EXPECT_EQ(inQuotes(std::string(1000, 'a')), "'" + std::string(40, 'a') + "...'");
}

} // namespace
} // namespace metamarch
