// The rows as a page for a README.
#pragma once
#include "metamarch/bench/row.h"

#include <span>
#include <string>

namespace metamarch::bench {

// Markdown: where the rows come from and what their numbers mean; then for each scene the speeds, one column
// per ray set, and below, folded away, all there is.
std::string resultsPage(const Origin& origin, std::span<const Row> rows);

} // namespace metamarch::bench
