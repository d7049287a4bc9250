// SPDX-License-Identifier: MIT
// Writes the rows as a Markdown page.
#pragma once
#include "metamarch/bench/row.h"

#include <span>
#include <string>

namespace metamarch::bench {

// Returns Markdown: where the rows come from and what their numbers mean; then, for each scene, the speeds
// with one column per ray set and, in a folded section, all columns.
std::string resultsPage(const Origin& origin, std::span<const Row> rows);

} // namespace metamarch::bench
