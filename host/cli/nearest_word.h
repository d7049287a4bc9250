// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace metamarch::cli {

// Returns the candidate that `word` most likely misspells: at most two letters are inserted, removed or
// replaced, and at most a third of the word's letters. Hyphens before the word do not count as letters.
// Returns "" if there is none.
std::string nearestWord(std::string_view word, const std::vector<std::string>& candidates);

} // namespace metamarch::cli
