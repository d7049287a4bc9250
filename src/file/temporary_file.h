// SPDX-License-Identifier: MIT
// A file under a name that nobody else has, which does not outlive the program.
#pragma once
#include <cstddef>
#include <filesystem>

namespace metamarch {

// The file lies in a folder, hidden, under a random name: processes that share the folder may have the same
// process id, and what a dead one left there must not be in the way. The destructor removes it.
class TemporaryFile {
  public:
    TemporaryFile() = default;
    ~TemporaryFile() { remove(); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    // Makes the file, with the mode that new files have. Returns its descriptor, open to read and write, or
    // -1 and errno.
    int create(const std::filesystem::path& folder);

    // Gives it this name in place of what had it; false and errno where that cannot be.
    bool renameTo(const std::filesystem::path& name);

    // Gives it this name unless something has it: then false and EEXIST.
    bool renameToFree(const std::filesystem::path& name);

    const std::filesystem::path& path() const { return path_; } // empty: there is none

  private:
    void remove();
    void forget();

    std::filesystem::path path_;
    std::size_t slot_ = 0;
};

// Removes the temporary files that are there. For the handler of a signal that ends the program: it calls
// nothing that a handler may not call.
void removeTemporaryFiles() noexcept;

} // namespace metamarch
