// SPDX-License-Identifier: MIT
// A file that one process keeps and writes again and again, and that is whole at every moment.
#pragma once
#include "metamarch/file/output_target.h"

#include <cstddef>
#include <filesystem>
#include <span>

namespace metamarch {

// The lock is on the file itself (flock): it goes with its process, however that ends, and leaves no second
// file behind. A new content is written to a temporary file in the same folder, which has its lock before it
// has its name.
class LockedFile {
  public:
    // Takes the lock if the file is there. Throws Error(outputNotWritable) where it cannot be written or
    // another process keeps it.
    explicit LockedFile(const std::filesystem::path& path);
    ~LockedFile();
    LockedFile(const LockedFile&) = delete;
    LockedFile& operator=(const LockedFile&) = delete;

    bool isThere() const { return descriptor_ >= 0; }

    // Makes these bytes, one piece after the other, the file's content, on the disk when it returns. Throws
    // Error(outputNotWritable); the file then is as it was before.
    void replace(std::span<const std::span<const std::byte>> pieces);

    // Deletes the file and gives up the lock.
    void remove();

  private:
    void close();
    [[noreturn]] void refuse(int reason) const;

    OutputTarget target_;
    int descriptor_ = -1; // of the file that has the name; it holds the lock
};

} // namespace metamarch
