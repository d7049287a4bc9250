// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace metamarch::cli {

// The commit this was built from: "0123abcd4567", with "-dirty" behind it where files differ.
std::string gitCommit();

// "metamarch 0.1.0 (0123abcd4567)".
std::string programVersion();

// The program, its commit and everything it was built with, a line each, without a newline at the end.
std::string versionText();

} // namespace metamarch::cli
