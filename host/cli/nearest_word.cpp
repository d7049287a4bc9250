// SPDX-License-Identifier: MIT
#include "metamarch/cli/nearest_word.h"

#include <algorithm>
#include <numeric>

namespace metamarch::cli {
namespace {

// Returns the Levenshtein distance. Keeps one row of the table at a time.
std::size_t editDistance(std::string_view from, std::string_view to) {
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({row[j + 1] + 1, row[j] + 1, replaced});
        }
    }
    return row.back();
}

} // namespace

std::string nearestWord(std::string_view word, const std::vector<std::string>& candidates) {
    constexpr std::size_t kMostErrors = 2;
    const std::size_t letters = word.size() - std::min(word.find_first_not_of('-'), word.size());
    std::string nearest;
    std::size_t limit = std::min(kMostErrors, letters / 3) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < limit) {
            limit = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

} // namespace metamarch::cli
