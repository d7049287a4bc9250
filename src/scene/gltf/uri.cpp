// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/uri.h"

#include <cctype>
#include <string_view>

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

// tinygltf turns '+' into a space and decodes bad escapes arbitrarily. If every unusual byte is escaped, it
// can only arrive at the name that was checked.
std::string percentEncoded(const std::string& name) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string encoded;
    for (const unsigned char c : name) {
        if (std::isalnum(c) != 0 || c == '.' || c == '/') {
            encoded += static_cast<char>(c);
        } else {
            encoded.append({'%', kDigits[c >> 4], kDigits[c & 15]});
        }
    }
    return encoded;
}

bool isReadable(const std::string& path, void* file) {
    std::error_code failure;
    return static_cast<const InputFile*>(file)->isBeside(path) &&
           std::filesystem::is_regular_file(path, failure);
}

bool readWhole(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void* file) {
    std::optional<std::vector<unsigned char>> read;
    if (isReadable(path, file)) {
        read = readBytes(path);
    }
    if (!read) {
        *error += "cannot be read";
        return false;
    }
    *bytes = std::move(*read);
    return true;
}

} // namespace

std::string checkedBufferUri(const InputFile& file, const std::string& label, const std::string& uri) {
    if (isDataUri(uri)) {
        const std::optional<std::string> known = octetStream(uri);
        if (!known) {
            file.refuse(label + ": a data URI that is not base64");
        }
        return *known;
    }
    const std::string decoded = fileNameOfUri(uri);
    if (const std::string reason = file.whyNotReadable(decoded); !reason.empty()) {
        file.refuse(label + ": '" + decoded + "' " + reason);
    }
    return percentEncoded(decoded);
}

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

tinygltf::FsCallbacks readOnlyBeside(InputFile& file) {
    return {.FileExists = isReadable,
            .ExpandFilePath = [](const std::string& path, void*) { return path; },
            .ReadWholeFile = readWhole,
            .WriteWholeFile = nullptr,
            .user_data = &file};
}

} // namespace metamarch
