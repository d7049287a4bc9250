// SPDX-License-Identifier: MIT
// Names for one warning.
#pragma once
#include <string>
#include <string_view>
#include <unordered_set>

namespace metamarch {

// Lists each name once, in the order in which they come, and counts those behind the first eight.
class NameList {
  public:
    void add(std::string_view name) {
        if (seen_.emplace(name).second && seen_.size() <= kMost) {
            text_ += (text_.empty() ? "" : ", ") + std::string(name.substr(0, kLongest)) +
                     (name.size() > kLongest ? "..." : "");
        }
    }

    bool empty() const { return seen_.empty(); }

    std::string text() const {
        return seen_.size() > kMost ? text_ + " and " + std::to_string(seen_.size() - kMost) + " more"
                                    : text_;
    }

  private:
    static constexpr std::size_t kMost = 8;
    static constexpr std::size_t kLongest = 40;

    std::unordered_set<std::string> seen_;
    std::string text_;
};

} // namespace metamarch
