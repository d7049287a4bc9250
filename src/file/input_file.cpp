// SPDX-License-Identifier: MIT
#include "metamarch/file/input_file.h"

#include "metamarch/error/error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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

// An open file. Closing it leaves errno as it was.
class Descriptor {
  public:
    explicit Descriptor(const int opened) : number(opened) {}
    ~Descriptor() {
        if (number >= 0) {
            const int reason = errno;
            close(number);
            errno = reason;
        }
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    const int number; // -1: it could not be opened
};

// Returns the first `most` characters and dots, or all if there are no more. Keeps UTF-8 whole.
std::string cut(const std::string& text, std::size_t most) {
    if (text.size() <= most) {
        return text;
    }
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) {
        --end;
    }
    return text.substr(0, end) + "...";
}

// Cuts every quotation and every word at kMostQuoted, and the whole at a length that fits a few lines of a
// terminal.
std::string shortened(const std::string& text) {
    constexpr std::size_t kMost = 1000;
    constexpr std::size_t kQuoted = InputFile::kMostQuoted;
    std::string result;
    for (std::size_t begin = 0; begin < text.size() && result.size() <= kMost;) {
        const bool isQuotation = text[begin] == '\'';
        const std::size_t found = text.find_first_of(isQuotation ? "'" : " '", begin + 1);
        const std::size_t end = std::min(found, text.size());
        const std::string piece = text.substr(begin, end - begin);
        result += isQuotation ? '\'' + cut(piece.substr(1), kQuoted) : cut(piece, kQuoted);
        if (isQuotation && end < text.size()) {
            result += '\'';
        }
        begin = end + (isQuotation ? 1 : 0);
    }
    return cut(result, kMost);
}

} // namespace

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)), files_{path_} {
    if (isStandardInput(path_)) {
        memory_ = readStandardInput();
        return;
    }
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(path_, failure);
    if (status.type() == std::filesystem::file_type::not_found) {
        refuse("no such file");
    }
    if (failure) {
        refuse(failure.message());
    }
    // Reading from a device or pipe might never end.
    if (!std::filesystem::is_regular_file(status)) {
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

InputFile::InputFile(const std::string& name, std::vector<unsigned char> bytes)
    : path_(name), files_{path_}, memory_(std::move(bytes)) {
    if (memory_->empty()) {
        refuse("nothing to read");
    }
}

std::vector<unsigned char> InputFile::readStandardInput() const {
    constexpr std::size_t kMost = std::size_t{1} << 32; // what a GLB can say of its own length
    constexpr std::size_t kAtOnce = std::size_t{1} << 20;
    std::vector<unsigned char> bytes;
    while (true) {
        const std::size_t before = bytes.size();
        bytes.resize(before + kAtOnce);
        const ssize_t count = ::read(STDIN_FILENO, &bytes[before], kAtOnce);
        bytes.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        if (count < 0 && errno != EINTR) {
            refuse(std::string("cannot be read: ") + std::strerror(errno));
        }
        if (bytes.size() > kMost) {
            refuseSize("more than 4 GiB");
        }
        if (count == 0) {
            break;
        }
    }
    if (bytes.empty()) {
        refuse("nothing to read");
    }
    return bytes;
}

std::vector<unsigned char> InputFile::read() const {
    if (memory_) {
        return *memory_;
    }
    std::optional<std::vector<unsigned char>> bytes = readBytes(path_);
    if (!bytes) {
        refuse(std::string("cannot be read: ") + std::strerror(errno));
    }
    return std::move(*bytes);
}

bool InputFile::isBeside(const std::filesystem::path& other) const {
    if (isInMemory()) {
        return false;
    }
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
    if (name.find("://") != std::string::npos || isInMemory()) {
        return "is not a file beside the scene";
    }
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(companion(name), failure);
    if (failure == std::errc::filename_too_long) {
        return "has too long a name";
    }
    if (std::filesystem::path(name).is_absolute() || name.find('\0') != std::string::npos ||
        !isBeside(companion(name))) {
        return "leaves the scene's folder";
    }
    if (failure && status.type() != std::filesystem::file_type::not_found) {
        return "cannot be read: " + failure.message();
    }
    return std::filesystem::is_regular_file(status) ? "" : "is missing";
}

std::string InputFile::portableName(const std::string& name) const {
    if (whyNotReadable(name).empty()) {
        return name;
    }
    std::string portable = name;
    std::ranges::replace(portable, '\\', '/');
    return portable;
}

void InputFile::refuse(const std::string& what, const std::vector<std::string>& settings) const {
    throw Error(ErrorKind::inputRefused, line(what), settings);
}

void InputFile::refuseSize(const std::string& what) const { throw Error(ErrorKind::outOfMemory, line(what)); }

void InputFile::warn(const std::string& what) {
    if (warned_.insert(what).second) {
        warnings_.push_back(line(what));
    }
}

std::string InputFile::line(const std::string& what) const {
    return oneLine((isStandardInput(path_) ? "standard input" : path_.string()) + ": " + shortened(what));
}

bool isStandardInput(const std::filesystem::path& path) { return path == "-"; }

std::optional<std::vector<unsigned char>> readBytes(const std::filesystem::path& path) {
    // A name that has become a pipe since it was looked at does not stop the program.
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (file.number < 0 || fstat(file.number, &status) != 0) {
        return std::nullopt;
    }
    std::vector<unsigned char> bytes(static_cast<std::size_t>(status.st_size));
    std::size_t size = 0;
    while (size < bytes.size()) {
        const ssize_t count = ::read(file.number, bytes.data() + size, bytes.size() - size);
        if (count > 0) {
            size += static_cast<std::size_t>(count);
        } else if (count == 0 || errno != EINTR) {
            errno = count == 0 ? EIO : errno; // somebody cut it off
            return std::nullopt;
        }
    }
    return bytes;
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

std::string lowerCaseEnding(const std::filesystem::path& path) {
    return lowerCase(path.extension().string());
}

std::string elementName(const char* kind, const std::string& name, std::size_t index) {
    return std::string(kind) + ' ' + (name.empty() ? std::to_string(index) : '\'' + name + '\'');
}

} // namespace metamarch
