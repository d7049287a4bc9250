#pragma once
#include <string>

namespace metamarch::cli {

// "metamarch 0.1.0 (0123abcd4567)".
std::string programVersion();

// The program, its commit and everything it was built with, a line each, without a newline at the end.
std::string versionText();

} // namespace metamarch::cli
