// SPDX-License-Identifier: MIT
// Measures wall-clock seconds since its construction.
#pragma once
#include <chrono>

namespace metamarch {

class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

  private:
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

} // namespace metamarch
