// SPDX-License-Identifier: MIT
// The glTF extensions that a file may require.
#pragma once
#include <span>
#include <string>

namespace metamarch {

// Returns true for extensions that are read, for those that do not affect the scene, and for image formats
// that are not decoded: a texture of one of these has a fallback, or is refused if a triangle uses it.
bool isSupportedExtension(const std::string& name);

// Returns the extensions whose images are not decoded.
std::span<const char* const> undecodedImageExtensions();

} // namespace metamarch
