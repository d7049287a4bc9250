// SPDX-License-Identifier: MIT
#include "metamarch/file/output_file.h"

#include "metamarch/error/error.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace metamarch {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
    throw Error(ErrorKind::outputNotWritable, "cannot write " + path.string() + ": " + reason);
}

// Returns the file that the rename must replace: the target of a symbolic link, not the link.
std::filesystem::path resolved(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::filesystem::path target = std::filesystem::canonical(path, ignored);
    return target.empty() ? path : target;
}

std::filesystem::path temporaryBeside(const std::filesystem::path& path) {
    static std::atomic<unsigned> counter = 0;
    const std::string name =
        ".metamarch-" + std::to_string(getpid()) + "-" + std::to_string(counter.fetch_add(1)) + ".tmp";
    return path.parent_path() / name;
}

void checkTarget(const std::filesystem::path& shown, const std::filesystem::path& target) {
    if (!target.has_filename()) {
        refuse(shown, "no file name given");
    }
    std::error_code unreachable;
    const std::filesystem::file_status status = std::filesystem::status(target, unreachable);
    if (status.type() == std::filesystem::file_type::not_found) {
        return;
    }
    if (unreachable) {
        refuse(shown, unreachable.message());
    }
    if (std::filesystem::is_directory(status)) {
        refuse(shown, "it is a folder");
    }
    if (!std::filesystem::is_regular_file(status)) {
        refuse(shown, "it is not a regular file");
    }
    if (access(target.c_str(), W_OK) != 0) {
        refuse(shown, std::strerror(errno));
    }
}

} // namespace

OutputFile::OutputFile(const std::filesystem::path& path)
    : shownPath_(path), finalPath_(resolved(path)), temporaryPath_(temporaryBeside(finalPath_)) {
    checkTarget(shownPath_, finalPath_);
    descriptor_ = open(temporaryPath_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
        refuse(shownPath_, errno == ENOENT ? "there is no such folder" : std::strerror(errno));
    }
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) {
        close(descriptor_);
    }
    if (!temporaryPath_.empty()) {
        unlink(temporaryPath_.c_str());
    }
}

bool OutputFile::write(std::uint64_t offset, const void* data, std::size_t size) noexcept {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0 && firstErrno_ == 0) {
        const ssize_t written = pwrite(descriptor_, bytes, size, static_cast<off_t>(offset));
        if (written < 0 && errno != EINTR) {
            firstErrno_ = errno;
        }
        if (written > 0) {
            bytes += written;
            offset += static_cast<std::uint64_t>(written);
            size -= static_cast<std::size_t>(written);
        }
    }
    return firstErrno_ == 0;
}

void OutputFile::commit() {
    // Without fsync, a system crash could leave the new name on an empty file.
    if (firstErrno_ == 0 && fsync(descriptor_) != 0) {
        firstErrno_ = errno;
    }
    if (close(std::exchange(descriptor_, -1)) != 0 && firstErrno_ == 0) {
        firstErrno_ = errno;
    }
    if (firstErrno_ == 0 && rename(temporaryPath_.c_str(), finalPath_.c_str()) != 0) {
        firstErrno_ = errno;
    }
    if (firstErrno_ != 0) {
        refuse(shownPath_, std::strerror(firstErrno_));
    }
    temporaryPath_.clear();
}

void writeText(const std::filesystem::path& path, std::string_view text) {
    OutputFile file(path);
    file.write(0, text.data(), text.size());
    file.commit();
}

} // namespace metamarch
