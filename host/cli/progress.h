// SPDX-License-Identifier: MIT
// A progress bar. It is drawn on terminals only.
#pragma once
#include <chrono>
#include <string>
#include <string_view>

namespace metamarch::cli {

// Draws on stderr during its lifetime if stderr is a terminal and the bar is `wanted`. Leaves a clean line
// behind.
class Progress {
  public:
    // Shows `firstLabel` until show() is called.
    Progress(std::string_view firstLabel, bool wanted);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::string_view newLabel, double part); // 0..1

  private:
    std::string label;
    bool visible;
    std::chrono::steady_clock::time_point lastDrawn{};
};

} // namespace metamarch::cli
