// SPDX-License-Identifier: MIT
// The user's folders for files that programs keep: https://specifications.freedesktop.org/basedir-spec/
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace metamarch {

// Returns the program's folder in the one that the environment's `variable` names, such as XDG_CACHE_HOME;
// without it in `otherwise` below the user's home. Returns nothing if neither the variable nor HOME holds an
// absolute path.
std::optional<std::filesystem::path> userFolder(const std::string& variable,
                                                const std::filesystem::path& otherwise);

} // namespace metamarch
