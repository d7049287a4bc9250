// SPDX-License-Identifier: MIT
#include "metamarch/file/user_folder.h"

#include <cstdlib>

namespace metamarch {
namespace {

// A relative path counts as unset.
std::optional<std::filesystem::path> absolutePath(const std::string& variable) {
    const char* const value = std::getenv(variable.c_str());
    if (value == nullptr || !std::filesystem::path(value).is_absolute()) {
        return std::nullopt;
    }
    return value;
}

} // namespace

std::optional<std::filesystem::path> userFolder(const std::string& variable,
                                                const std::filesystem::path& otherwise) {
    if (const auto folder = absolutePath(variable)) {
        return *folder / "metamarch";
    }
    if (const auto home = absolutePath("HOME")) {
        return *home / otherwise / "metamarch";
    }
    return std::nullopt;
}

} // namespace metamarch
