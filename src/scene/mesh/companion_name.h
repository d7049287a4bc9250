// SPDX-License-Identifier: MIT
// Finds the files that an OBJ, its MTL or a PLY names.
#pragma once
#include "metamarch/file/input_file.h"

#include <string>
#include <string_view>

namespace metamarch {

// Returns the name, relative to the folder of `file`, of what a file in the folder `from` calls `name`.
//
// `name` may be quoted, may have another system's separators, and a comment may follow it. It is looked for
// in `from` (relative to the folder of `file`; empty for that folder itself) and in the folder of `file`. If
// it is not there, or is absolute, its last part is looked for in both. A name that leaves the folder of
// `file` is never replaced. If nothing is found, the name is returned as it is, for the message.
std::string companionName(const InputFile& file, const std::string& from, std::string_view name);

} // namespace metamarch
