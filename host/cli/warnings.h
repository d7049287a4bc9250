// SPDX-License-Identifier: MIT
// Prints what the user should know about a scene that is read in spite of its flaws.
#pragma once
#include <string>
#include <vector>

namespace metamarch::cli {

// Prints a line each on stderr.
void printWarnings(const std::vector<std::string>& warnings);

} // namespace metamarch::cli
