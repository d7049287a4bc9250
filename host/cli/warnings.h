// SPDX-License-Identifier: MIT
// What the user should know of a scene that is read all the same.
#pragma once
#include <string>
#include <vector>

namespace metamarch::cli {

// On stderr, a line each.
void printWarnings(const std::vector<std::string>& warnings);

} // namespace metamarch::cli
