// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/companion_name.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace metamarch {
namespace {

std::string_view unquoted(std::string_view name) {
    const bool isQuoted =
        name.size() > 1 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front();
    return isQuoted ? name.substr(1, name.size() - 2) : name;
}

// A name from Windows may be absolute too.
bool isAbsolute(const std::string& name) {
    const bool hasDrive =
        name.size() > 1 && name[1] == ':' && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
    return hasDrive || name.starts_with('/');
}

} // namespace

std::string companionName(const InputFile& file, const std::string& from, std::string_view name) {
    std::vector<std::string> spellings = {std::string(unquoted(name))};
    if (const std::size_t comment = name.find(" #"); comment != std::string_view::npos) {
        const std::string_view before = name.substr(0, comment);
        spellings.emplace_back(unquoted(before.substr(0, before.find_last_not_of(' ') + 1)));
    }
    const std::filesystem::path folder(from);
    for (std::string& spelling : spellings) {
        std::ranges::replace(spelling, '\\', '/');
        std::vector<std::string> tried;
        if (!isAbsolute(spelling)) {
            tried.push_back((folder / spelling).generic_string());
            tried.push_back(spelling);
        }
        if (isAbsolute(spelling) || file.isBeside(file.companion(tried.front()))) {
            const std::string last = spelling.substr(spelling.rfind('/') + 1);
            tried.push_back((folder / last).generic_string());
            tried.push_back(last);
        }
        const auto found = std::ranges::find_if(tried, [&](const std::string& each) {
            std::error_code failure;
            return std::filesystem::exists(file.companion(each), failure) &&
                   file.whyNotReadable(each).empty();
        });
        if (found != tried.end()) {
            return std::filesystem::path(*found).lexically_normal().generic_string();
        }
    }
    return isAbsolute(spellings[0]) ? spellings[0] : (folder / spellings[0]).generic_string();
}

} // namespace metamarch
