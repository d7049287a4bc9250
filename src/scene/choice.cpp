// SPDX-License-Identifier: MIT
#include "metamarch/scene/choice.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace metamarch {

std::size_t chooseIndex(const std::string& kind, const std::vector<std::string>& names,
                        const std::string& selection, const std::string& owner) {
    std::size_t index = 0;
    const char* const end = selection.data() + selection.size();
    const auto [stop, error] = std::from_chars(selection.data(), end, index);
    if (error == std::errc() && stop == end && index < names.size()) {
        return index;
    }
    const auto found = std::ranges::find(names, selection);
    if (found != names.end()) {
        return static_cast<std::size_t>(found - names.begin());
    }
    std::vector<std::string> list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        list.push_back(fmt::format("{} '{}'", i, names[i]));
    }
    throw Error(ErrorKind::invalidArgument,
                fmt::format("there is no {} {}; the {} has {}", kind, selection, owner,
                            list.empty() ? "none" : fmt::format("{}", fmt::join(list, ", "))),
                {kind});
}

} // namespace metamarch
