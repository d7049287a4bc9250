// SPDX-License-Identifier: MIT
#include "metamarch/file/input_file.h"

#include "metamarch/error/error.h"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace metamarch {
namespace {

// Replaces control characters: library messages and names in hostile files may contain line breaks and
// terminal escapes.
std::string oneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

} // namespace

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code failure;
    if (!std::filesystem::exists(path_, failure)) {
        refuse("no such file");
    }
    // Reading from a device or pipe might never end.
    if (!std::filesystem::is_regular_file(path_, failure)) {
        refuse("not a regular file");
    }
    if (std::filesystem::file_size(path_, failure) == 0) {
        refuse("the file is empty");
    }
    folder_ = std::filesystem::canonical(path_, failure).parent_path();
    if (failure) {
        refuse(failure.message());
    }
}

std::vector<unsigned char> InputFile::read() const {
    std::optional<std::vector<unsigned char>> bytes = readBytes(path_);
    if (!bytes) {
        refuse("cannot be opened and read to its end");
    }
    return std::move(*bytes);
}

bool InputFile::isBeside(const std::filesystem::path& other) const {
    std::error_code failure;
    // Make the path absolute first: weakly_canonical leaves a relative path unchanged if none of its folders
    // exist.
    const std::filesystem::path resolved =
        std::filesystem::weakly_canonical(std::filesystem::absolute(other), failure);
    if (failure) {
        return false;
    }
    return std::mismatch(folder_.begin(), folder_.end(), resolved.begin(), resolved.end()).first ==
           folder_.end();
}

std::string InputFile::whyNotReadable(const std::string& name) const {
    if (name.find("://") != std::string::npos) {
        return "is not a file beside the scene";
    }
    std::error_code failure;
    const bool isFile = std::filesystem::is_regular_file(companion(name), failure);
    if (failure == std::errc::filename_too_long) {
        return "has too long a name";
    }
    if (std::filesystem::path(name).is_absolute() || name.find('\0') != std::string::npos ||
        !isBeside(companion(name))) {
        return "leaves the scene's folder";
    }
    return isFile ? "" : "is missing";
}

void InputFile::refuse(const std::string& what) const { throw Error(ErrorKind::inputRefused, line(what)); }

void InputFile::refuseSize(const std::string& what) const { throw Error(ErrorKind::outOfMemory, line(what)); }

void InputFile::warn(const std::string& what) {
    if (warned_.insert(what).second) {
        warnings_.push_back(line(what));
    }
}

std::string InputFile::line(const std::string& what) const { return oneLine(path_.string() + ": " + what); }

std::optional<std::vector<unsigned char>> readBytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    if (!stream) {
        return std::nullopt;
    }
    std::vector<unsigned char> bytes(static_cast<std::size_t>(stream.tellg()));
    stream.seekg(0);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
        return std::nullopt;
    }
    return bytes;
}

std::string lowerCaseEnding(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::string elementName(const char* kind, const std::string& name, std::size_t index) {
    return std::string(kind) + ' ' + (name.empty() ? std::to_string(index) : '\'' + name + '\'');
}

} // namespace metamarch
