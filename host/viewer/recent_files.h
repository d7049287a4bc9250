// SPDX-License-Identifier: MIT
// The scenes that windows have shown, in a list that is kept between runs.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

namespace metamarch::viewer {

// A text file with one absolute path a line, the newest first. The list is a convenience: a missing or broken
// file is an empty list, and a failure to write is not an error.
class RecentFiles {
  public:
    static constexpr std::size_t kMost = 10;

    // In $XDG_STATE_HOME/metamarch or ~/.local/state/metamarch.
    RecentFiles();

    // Returns the files that are still there, the newest first.
    std::vector<std::filesystem::path> read() const;
    // Puts a scene in front of what the list holds now: other windows write to it as well.
    void add(const std::filesystem::path& scene) const;

  private:
    std::optional<std::filesystem::path> list_;
};

} // namespace metamarch::viewer
