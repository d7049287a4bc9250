// SPDX-License-Identifier: MIT
#include "metamarch/file/locked_file.h"

#include "metamarch/file/folder_sync.h"
#include "metamarch/file/temporary_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace metamarch {
namespace {

// Whether the name still belongs to the open file: another process may have replaced it.
bool hasName(const int descriptor, const std::filesystem::path& path) {
    struct stat opened {};
    struct stat named {};
    return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

// Writes all of it; false and errno on failure.
bool writeAll(const int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(descriptor, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

} // namespace

LockedFile::LockedFile(const std::filesystem::path& path) : target_(path) {
    if (target_.isStream()) {
        target_.refuse("not a regular file");
    }
    while (true) {
        descriptor_ = open(target_.path.c_str(), O_RDWR | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
        if (descriptor_ < 0) {
            if (errno == ENOENT) {
                return;
            }
            refuse(errno);
        }
        if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
            const int reason = errno;
            close();
            refuse(reason);
        }
        if (hasName(descriptor_, target_.path)) {
            return;
        }
        close();
    }
}

LockedFile::~LockedFile() { close(); }

void LockedFile::replace(const std::span<const std::span<const std::byte>> pieces) {
    const std::filesystem::path folder = target_.path.has_parent_path() ? target_.path.parent_path() : ".";
    TemporaryFile temporary;
    const int fresh = temporary.create(folder);
    if (fresh < 0) {
        refuse(errno);
    }
    bool done = flock(fresh, LOCK_EX | LOCK_NB) == 0;
    for (const std::span<const std::byte> piece : pieces) {
        done = done && writeAll(fresh, piece);
    }
    done = done && fsync(fresh) == 0 &&
           (isThere() ? temporary.renameTo(target_.path) : temporary.renameToFree(target_.path));
    if (!done) {
        const int reason = errno;
        ::close(fresh);
        refuse(reason);
    }
    close();
    descriptor_ = fresh;
    syncFolder(folder);
}

void LockedFile::remove() {
    if (isThere()) {
        unlink(target_.path.c_str());
        close();
    }
}

void LockedFile::close() {
    if (descriptor_ >= 0) {
        ::close(std::exchange(descriptor_, -1));
    }
}

void LockedFile::refuse(const int reason) const {
    target_.refuse(reason == EWOULDBLOCK || reason == EEXIST ? "another process writes it"
                                                             : std::strerror(reason));
}

} // namespace metamarch
