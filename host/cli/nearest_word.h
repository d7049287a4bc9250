// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace metamarch::cli {

// The candidate that `word` is most likely a misspelling of: at most two letters inserted, removed or
// replaced, and at most a third of the word's letters. Hyphens before the word do not count as letters. Empty
// when there is none.
std::string nearestWord(std::string_view word, const std::vector<std::string>& candidates);

} // namespace metamarch::cli
