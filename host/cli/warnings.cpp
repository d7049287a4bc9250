// SPDX-License-Identifier: MIT
#include "metamarch/cli/warnings.h"

#include <fmt/format.h>

#include <cstdio>

namespace metamarch::cli {

void printWarnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
        fmt::print(stderr, "metamarch: warning: {}\n", warning);
    }
}

} // namespace metamarch::cli
