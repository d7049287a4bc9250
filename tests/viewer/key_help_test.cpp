// SPDX-License-Identifier: MIT
#include "metamarch/viewer/controls.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace metamarch::viewer {
namespace {

// The rows of the table under "## Keys", without its two lines of headings.
std::vector<std::string> rowsOfReadme() {
    std::ifstream readme(METAMARCH_SOURCE_DIR "/host/viewer/README.md");
    std::vector<std::string> rows;
    bool isThere = false;
    for (std::string line; std::getline(readme, line);) {
        isThere = line.starts_with("## ") ? line == "## Keys" : isThere;
        if (isThere && line.starts_with("| ") && line != "| keys | what they do |") {
            rows.push_back(line);
        }
    }
    return rows;
}

TEST(KeyHelp, isTheTableOfTheReadme) {
    std::vector<std::string> rows;
    for (const KeyHelp& help : keyHelp()) {
        rows.push_back("| " + std::string(help.keys) + " | " + std::string(help.what) + " |");
    }
    EXPECT_EQ(rowsOfReadme(), rows);
}

} // namespace
} // namespace metamarch::viewer
