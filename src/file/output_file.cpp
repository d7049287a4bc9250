// SPDX-License-Identifier: MIT
#include "metamarch/file/output_file.h"

#include "metamarch/file/folder_sync.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace metamarch {
namespace {

using Kind = OutputTarget::Kind;

std::filesystem::path folderOf(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

// Gives the new file the mode and owner of the file at `path`. Only root may change the owner. Where both
// cannot be changed, the group alone is tried; where that fails too, the file stays with this user.
void copyModeAndOwner(const std::filesystem::path& path, const int descriptor) {
    struct stat former {};
    if (stat(path.c_str(), &former) != 0) {
        return;
    }
    constexpr uid_t kSameUser = static_cast<uid_t>(-1);
    [[maybe_unused]] const bool isGroupSet = fchown(descriptor, former.st_uid, former.st_gid) == 0 ||
                                             fchown(descriptor, kSameUser, former.st_gid) == 0;
    fchmod(descriptor, former.st_mode & 0777);
}

// Writes all of it; false and errno on failure.
bool writeAll(const int descriptor, const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t written = write(descriptor, bytes, size);
        if (written >= 0) {
            bytes += written;
            size -= static_cast<std::size_t>(written);
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) { // a pipe that somebody set so
            pollfd waited{descriptor, POLLOUT, 0};
            poll(&waited, 1, -1);
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

// The bytes of one file, from its start, to the end of the other; false and errno on failure.
bool copyAll(const int from, const int to) {
    static thread_local std::array<char, 1 << 16> bytes;
    off_t offset = 0;
    while (true) {
        const ssize_t count = pread(from, bytes.data(), bytes.size(), offset);
        if (count == 0) {
            return true;
        }
        if (count < 0 || !writeAll(to, bytes.data(), static_cast<std::size_t>(count))) {
            return false;
        }
        offset += count;
    }
}

// Puts the bytes of `from` in the place of the file's own; false and errno on failure. A disk that has no
// room for them leaves the file as it was.
bool overwrite(const std::filesystem::path& path, const int from) {
    struct stat source {};
    const int to = open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (to < 0) {
        return false;
    }
    bool done = fstat(from, &source) == 0;
    const auto isFull = [] { return errno == ENOSPC || errno == EDQUOT || errno == EFBIG; };
    if (done && source.st_size > 0 && fallocate(to, FALLOC_FL_KEEP_SIZE, 0, source.st_size) != 0 &&
        isFull()) {
        done = false; // other failures: this file system reserves nothing
    }
    done = done && copyAll(from, to) && ftruncate(to, source.st_size) == 0 && fsync(to) == 0;
    const int reason = errno;
    const bool isClosed = close(to) == 0;
    errno = done ? errno : reason;
    return done && isClosed;
}

bool sendToDescriptor(const int from, const int to) {
    if (to == STDOUT_FILENO) {
        std::fflush(stdout); // what was printed before comes before
    }
    return copyAll(from, to);
}

bool sendToStream(const std::filesystem::path& path, const int from) {
    const int to = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY);
    if (to < 0) {
        return false;
    }
    const bool done = copyAll(from, to);
    const int reason = errno;
    const bool isClosed = close(to) == 0;
    errno = done ? errno : reason;
    return done && isClosed;
}

} // namespace

OutputFile::OutputFile(const std::filesystem::path& path) : target_(path) {
    if (target_.isStream()) {
        collectInMemory();
        return;
    }
    descriptor_ = temporary_.create(folderOf(target_.path));
    if (descriptor_ < 0) {
        const bool isClosedFolder = errno == EACCES || errno == EPERM || errno == EROFS;
        if (target_.kind == Kind::fresh || !isClosedFolder) {
            target_.refuse(errno == ENOENT ? "there is no such folder" : std::strerror(errno));
        }
        collectInMemory();
    } else if (target_.kind == Kind::file) {
        copyModeAndOwner(target_.path, descriptor_);
    }
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) {
        close(descriptor_);
    }
}

void OutputFile::collectInMemory() {
    descriptor_ = memfd_create("metamarch", MFD_CLOEXEC);
    if (descriptor_ < 0) {
        target_.refuse(std::strerror(errno));
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

// The temporary file becomes the target. Where the rename is refused (a mount point, a sticky folder with
// somebody else's file), the target is overwritten.
void OutputFile::replace() {
    // Without fsync, a system crash could leave the new name on an empty file.
    if (fsync(descriptor_) != 0 || close(std::exchange(descriptor_, -1)) != 0) {
        firstErrno_ = errno;
        return;
    }
    if (temporary_.renameTo(target_.path)) {
        syncFolder(folderOf(target_.path));
        return;
    }
    firstErrno_ = errno;
    if (target_.kind == Kind::file) {
        descriptor_ = open(temporary_.path().c_str(), O_RDONLY | O_CLOEXEC);
        firstErrno_ = descriptor_ >= 0 && overwrite(target_.path, descriptor_) ? 0 : errno;
    }
}

void OutputFile::commit() {
    if (firstErrno_ == 0) {
        const auto take = [&](const bool done) { firstErrno_ = done ? 0 : errno; };
        if (target_.kind == Kind::descriptor) {
            take(sendToDescriptor(descriptor_, target_.descriptor));
        } else if (target_.kind == Kind::stream) {
            take(sendToStream(target_.path, descriptor_));
        } else if (temporary_.path().empty()) {
            take(overwrite(target_.path, descriptor_));
        } else {
            replace();
        }
    }
    if (firstErrno_ != 0) {
        target_.refuse(std::strerror(firstErrno_));
    }
}

void writeText(const std::filesystem::path& path, std::string_view text) {
    OutputFile file(path);
    file.write(0, text.data(), text.size());
    file.commit();
}

} // namespace metamarch
