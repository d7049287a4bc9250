// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>

namespace metamarch {

// Makes the names in the folder last through a crash of the system. Where the file system cannot, nothing
// happens: the files are as they would be without the call.
void syncFolder(const std::filesystem::path& folder) noexcept;

} // namespace metamarch
