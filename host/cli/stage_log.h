// SPDX-License-Identifier: MIT
// What the program does and how long that takes: for --verbose.
#pragma once
#include "metamarch/render/stopwatch.h"

#include <string_view>

namespace metamarch::cli {

class StageLog {
  public:
    explicit StageLog(const bool wanted) : isWanted(wanted) {}

    // Prints on standard error what ended now, with the seconds since the last end.
    void end(std::string_view what);

  private:
    bool isWanted;
    Stopwatch stopwatch;
};

} // namespace metamarch::cli
