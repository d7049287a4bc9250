// SPDX-License-Identifier: MIT
// URIs of glTF buffers and images.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace metamarch {

// Returns the bytes of a data URI, or nothing if it is not base64.
std::optional<std::vector<unsigned char>> bytesOfDataUri(const std::string& uri);
bool isDataUri(const std::string& uri);

// Returns the file name in a URI that is not a data URI, with percent escapes decoded.
std::string fileNameOfUri(const std::string& uri);

} // namespace metamarch
