// SPDX-License-Identifier: MIT
#include "metamarch/file/output_target.h"

#include "metamarch/error/error.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <string_view>
#include <sys/vfs.h>
#include <unistd.h>

namespace metamarch {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;           // as Linux follows
constexpr long kProcFileSystem = 0x9fa0; // f_type of /proc, see statfs(2)

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

// The number of a descriptor of this process that the path names: N of /proc/self/fd/N, however it is spelt.
std::optional<int> ownDescriptor(const fs::path& path) {
    const std::string digits = path.filename().string();
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size()) {
        return std::nullopt;
    }
    std::error_code failure;
    const fs::path folder = fs::canonical(folderOf(path), failure);
    const fs::path ours = fs::canonical("/proc/self/fd", failure);
    return !failure && folder == ours ? std::optional(number) : std::nullopt;
}

// The links there lead to what a process has open, whatever the name that they give for it.
bool isInProc(const fs::path& path) {
    struct statfs system {};
    return statfs(folderOf(path).c_str(), &system) == 0 && system.f_type == kProcFileSystem;
}

void checkDescriptor(const OutputTarget& target) {
    const int flags = fcntl(target.descriptor, F_GETFL);
    if (flags == -1 || (flags & O_ACCMODE) == O_RDONLY) {
        target.refuse("this stream is closed, or not for writing");
    }
}

} // namespace

OutputTarget::OutputTarget(const fs::path& name) : shown(name), path(name) {
    if (name == "-") {
        kind = Kind::descriptor;
        descriptor = STDOUT_FILENO;
        checkDescriptor(*this);
        return;
    }
    if (!name.has_filename()) {
        refuse("no file name given");
    }
    std::error_code failure;
    for (int links = 0;; ++links) {
        if (const std::optional<int> own = ownDescriptor(path)) {
            kind = Kind::descriptor;
            descriptor = *own;
            checkDescriptor(*this);
            return;
        }
        if (!fs::is_symlink(fs::symlink_status(path, failure)) || isInProc(path)) {
            break;
        }
        if (links == kMostLinks) {
            refuse(std::strerror(ELOOP));
        }
        path = folderOf(path) / fs::read_symlink(path, failure); // an absolute one replaces the folder
    }
    const fs::file_status status = fs::status(path, failure);
    if (status.type() == fs::file_type::not_found) {
        return;
    }
    if (failure) {
        refuse(failure.message());
    }
    if (fs::is_directory(status)) {
        refuse("it is a folder");
    }
    if (access(path.c_str(), W_OK) != 0) {
        refuse(std::strerror(errno));
    }
    kind = fs::is_regular_file(status) && !isInProc(path) ? Kind::file : Kind::stream;
}

void OutputTarget::refuse(const std::string& reason) const {
    throw Error(ErrorKind::outputNotWritable, "cannot write " + shown.string() + ": " + reason);
}

bool isSameOutput(const fs::path& a, const fs::path& b) {
    const OutputTarget first(a);
    const OutputTarget second(b);
    if (first.kind == OutputTarget::Kind::descriptor || second.kind == OutputTarget::Kind::descriptor) {
        return first.descriptor == second.descriptor;
    }
    std::error_code failure;
    if (fs::is_character_file(first.path, failure)) { // /dev/null takes any number
        return false;
    }
    return fs::weakly_canonical(fs::absolute(first.path), failure) ==
           fs::weakly_canonical(fs::absolute(second.path), failure);
}

bool isStandardOutput(const fs::path& name) { return OutputTarget(name).descriptor == STDOUT_FILENO; }

} // namespace metamarch
