// SPDX-License-Identifier: MIT
#include "metamarch/file/temporary_file.h"

#include <climits>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <random>
#include <string>
#include <unistd.h>

namespace metamarch {
namespace {

// Where a signal handler finds the names. A slot is never freed, so a handler that runs beside the other
// threads reads no dead memory.
struct Slot {
    std::atomic<bool> isTaken = false;
    std::atomic<bool> isNamed = false; // `name` is whole
    std::array<char, PATH_MAX> name{};
};

std::array<Slot, 8> slots; // the program writes one or two files at a time

// slots.size() where none is free, or the name is too long to be one.
std::size_t takeSlot(const std::string& name) {
    if (name.size() >= PATH_MAX) {
        return slots.size();
    }
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (!slots[i].isTaken.exchange(true)) {
            std::memcpy(slots[i].name.data(), name.c_str(), name.size() + 1);
            slots[i].isNamed = true;
            return i;
        }
    }
    return slots.size();
}

void freeSlot(const std::size_t slot) {
    if (slot < slots.size()) {
        slots[slot].isNamed = false;
        slots[slot].isTaken = false;
    }
}

std::string randomName() {
    std::random_device random;
    const std::uint64_t number = (std::uint64_t{random()} << 32) | random();
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(number));
    return std::string(".metamarch-") + digits.data() + ".tmp";
}

} // namespace

int TemporaryFile::create(const std::filesystem::path& folder) {
    while (true) {
        path_ = folder / randomName();
        // Before the file is there: a signal may come at any time.
        slot_ = takeSlot(path_.string());
        const int descriptor = open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            return descriptor;
        }
        const int reason = errno;
        forget();
        if (reason != EEXIST) {
            errno = reason;
            return -1;
        }
    }
}

bool TemporaryFile::renameTo(const std::filesystem::path& name) {
    if (rename(path_.c_str(), name.c_str()) != 0) {
        return false;
    }
    forget();
    return true;
}

bool TemporaryFile::renameToFree(const std::filesystem::path& name) {
    // Some file systems (NFS) do not know the flag.
    if (renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) != 0) {
        return errno == EINVAL && access(name.c_str(), F_OK) != 0 && renameTo(name);
    }
    forget();
    return true;
}

void TemporaryFile::remove() {
    if (!path_.empty()) {
        unlink(path_.c_str());
        forget();
    }
}

void TemporaryFile::forget() {
    freeSlot(slot_);
    path_.clear();
}

void removeTemporaryFiles() noexcept {
    for (const Slot& slot : slots) {
        if (slot.isNamed) {
            unlink(slot.name.data());
        }
    }
}

} // namespace metamarch
