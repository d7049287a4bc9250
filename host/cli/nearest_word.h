// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace metamarch::cli {

// The candidate that `word` is most likely a misspelling of: at most two letters inserted, removed or
// replaced, and fewer than half of the word. Empty when there is none.
std::string nearestWord(std::string_view word, const std::vector<std::string>& candidates);

} // namespace metamarch::cli
