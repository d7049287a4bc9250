// SPDX-License-Identifier: MIT
#include "metamarch/cli/stage_log.h"

#include "metamarch/file/standard_stream.h"

#include <fmt/format.h>

namespace metamarch::cli {

void StageLog::end(const std::string_view what) {
    if (isWanted) {
        printError(fmt::format("metamarch: {:8.3f} s  {}\n", stopwatch.seconds(), what));
        stopwatch = Stopwatch();
    }
}

} // namespace metamarch::cli
