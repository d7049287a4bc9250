// SPDX-License-Identifier: MIT
// Tells files of the same name apart.
#pragma once
#include <filesystem>
#include <string>

namespace metamarch {

// Returns the SHA-1 of the file's bytes as sha1sum prints it; empty if the file cannot be read.
std::string sha1Of(const std::filesystem::path& file);

} // namespace metamarch
