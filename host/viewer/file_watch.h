// SPDX-License-Identifier: MIT
// Files that somebody else may change.
#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <vector>

namespace metamarch::viewer {

class FileWatch {
  public:
    // From now on these: files, or folders with all that is in them. What they are like now is no change.
    void watch(const std::vector<std::filesystem::path>& places);

    // Whether something has changed since the last time this said so, and has been left alone since the last
    // look: who writes a file may not be done. Looks four times a second at most.
    bool hasChanged();

  private:
    using State = std::map<std::filesystem::path, std::filesystem::file_time_type>;

    State look() const;

    std::vector<std::filesystem::path> watched;
    State known;
    State seen; // at the last look
    std::chrono::steady_clock::time_point lastLook;
};

} // namespace metamarch::viewer
