// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/uri.h"

#include <tiny_gltf.h>

#include <cctype>

namespace metamarch {
namespace {

// Replaces the media type, because tinygltf knows only a few and the bytes are the same for all. Returns
// nothing if the URI is not base64.
std::optional<std::string> octetStream(const std::string& dataUri) {
    const std::size_t encoding = dataUri.find(";base64,");
    if (encoding == std::string::npos || encoding > dataUri.find(',')) {
        return std::nullopt;
    }
    return "data:application/octet-stream" + dataUri.substr(encoding);
}

} // namespace

bool isDataUri(const std::string& uri) { return uri.starts_with("data:"); }

std::optional<std::vector<unsigned char>> bytesOfDataUri(const std::string& uri) {
    const std::optional<std::string> known = octetStream(uri);
    std::vector<unsigned char> bytes;
    std::string mediaType;
    if (!known || !tinygltf::DecodeDataURI(&bytes, mediaType, *known, 0, false)) {
        return std::nullopt;
    }
    return bytes;
}

std::string fileNameOfUri(const std::string& uri) {
    const auto digit = [](char c) { return c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10; };
    const auto isDigit = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && isDigit(uri[i + 1]) && isDigit(uri[i + 2])) {
            decoded += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
            i += 2;
        } else {
            decoded += uri[i];
        }
    }
    return decoded;
}

} // namespace metamarch
