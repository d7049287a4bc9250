// SPDX-License-Identifier: MIT
#include "metamarch/cli/warnings.h"

#include "metamarch/file/standard_stream.h"

#include <fmt/format.h>

#include <cstdio>

namespace metamarch::cli {

void printWarnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
        printError(fmt::format("metamarch: warning: {}\n", warning));
    }
}

} // namespace metamarch::cli
