#include "scene/gltf_uri.h"

#include <cctype>
#include <fstream>
#include <iterator>
#include <string_view>

namespace metamarch {
namespace {

std::string percentDecoded(const std::string& uri) {
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

// tinygltf turns '+' into a space and bad escapes into anything. With every unusual byte escaped it can only
// arrive at the name that was checked.
std::string percentEncoded(const std::string& name) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string encoded;
    for (const unsigned char c : name) {
        if (std::isalnum(c) != 0 || c == '.' || c == '/')
            encoded += static_cast<char>(c);
        else
            encoded.append({'%', kDigits[c >> 4], kDigits[c & 15]});
    }
    return encoded;
}

bool isReadable(const std::string& path, void* file) {
    std::error_code failure;
    return static_cast<const SceneFile*>(file)->isBeside(path) &&
           std::filesystem::is_regular_file(path, failure);
}

bool readWhole(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void* file) {
    std::ifstream stream(path, std::ios::binary);
    if (!isReadable(path, file) || !stream) {
        *error += "cannot be opened for reading";
        return false;
    }
    bytes->assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    return true;
}

} // namespace

std::string checkedBufferUri(const SceneFile& file, const std::string& label, const std::string& uri) {
    if (uri.starts_with("data:")) {
        // tinygltf knows a handful of media types; the bytes are the same under any.
        const std::size_t encoding = uri.find(";base64,");
        if (encoding == std::string::npos || encoding > uri.find(','))
            file.refuse(label + ": a data URI that is not base64");
        return "data:application/octet-stream" + uri.substr(encoding);
    }
    const std::string decoded = percentDecoded(uri);
    const std::string quoted = label + ": '" + decoded + "'";
    if (decoded.find("://") != std::string::npos)
        file.refuse(quoted + " is not a file beside the scene");
    const std::filesystem::path name(decoded);
    const std::filesystem::path path = file.path().parent_path() / name;
    if (name.is_absolute() || decoded.find('\0') != std::string::npos || !file.isBeside(path))
        file.refuse(quoted + " leaves the scene's folder");
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure))
        file.refuse(quoted + " is missing");
    return percentEncoded(decoded);
}

tinygltf::FsCallbacks readOnlyBeside(SceneFile& file) {
    return {.FileExists = isReadable,
            .ExpandFilePath = [](const std::string& path, void*) { return path; },
            .ReadWholeFile = readWhole,
            .WriteWholeFile = nullptr,
            .user_data = &file};
}

} // namespace metamarch
