// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace metamarch::cli {

// Returns the commit of the build: "0123abcd4567", followed by "-dirty" if files differ from it.
std::string gitCommit();

// Returns "metamarch 0.1.0 (0123abcd4567)".
std::string programVersion();

// Returns a line each for the program with its commit and for everything that it was built with. No newline
// ends it.
std::string versionText();

} // namespace metamarch::cli
