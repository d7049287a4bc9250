// SPDX-License-Identifier: MIT
// The glTF extensions that a file may require.
#pragma once
#include <string>

namespace metamarch {

// Returns true for extensions that are read, and for those that do not affect the scene.
bool isSupportedExtension(const std::string& name);

} // namespace metamarch
