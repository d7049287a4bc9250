// SPDX-License-Identifier: MIT
// Prints for --verbose what the program does, and how long that takes.
#pragma once
#include "metamarch/render/stopwatch.h"

#include <string_view>

namespace metamarch::cli {

class StageLog {
  public:
    explicit StageLog(const bool wanted) : isWanted(wanted) {}

    // Prints on standard error that a stage ends now, with the seconds since the end of the stage before.
    void end(std::string_view what);

  private:
    bool isWanted;
    Stopwatch stopwatch;
};

} // namespace metamarch::cli
