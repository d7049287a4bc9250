// SPDX-License-Identifier: MIT
// Detects changes of files that other programs write.
#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <vector>

namespace metamarch::viewer {

class FileWatch {
  public:
    // Watches `places` from now on, in place of earlier ones. A place is a file, or a folder with all files
    // under it. Their present state is not a change.
    void watch(const std::vector<std::filesystem::path>& places);

    // Returns true once for each change, and only after two looks in a row have seen the same state, because
    // another program may still be writing. Looks at most four times a second.
    bool hasChanged();

    // Returns true once hasChanged() has found nothing left of the places, in two looks in a row.
    bool areGone() const { return gone; }

  private:
    using State = std::map<std::filesystem::path, std::filesystem::file_time_type>;

    State look() const;

    std::vector<std::filesystem::path> watched;
    State known;
    State seen; // at the last look
    bool gone = false;
    std::chrono::steady_clock::time_point lastLook;
};

} // namespace metamarch::viewer
