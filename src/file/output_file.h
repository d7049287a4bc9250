// SPDX-License-Identifier: MIT
// The output files of the program: all of them are written here.
#pragma once
#include "metamarch/file/output_target.h"
#include "metamarch/file/temporary_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace metamarch {

// A file that appears under its name only when it is complete. It is written to a temporary file in the same
// folder, which commit() renames. Without a commit the temporary file is removed and an existing file stays
// as it is. A new file takes the mode of the file that it replaces and, where that is permitted, its owner.
//
// A rename cannot replace every target: not a device, a pipe, a standard stream (see OutputTarget), a file in
// a folder that takes no new files, or a mount point. commit() then copies the complete bytes to the target.
//
// To check that a path is writable, construct an OutputFile and destroy it. The constructor and commit()
// throw Error(outputNotWritable).
class OutputFile {
  public:
    explicit OutputFile(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    // Returns false on failure and ever after; commit() reports the reason. Never throws, because image
    // libraries call it.
    bool write(std::uint64_t offset, const void* data, std::size_t size) noexcept;

    bool failed() const { return firstErrno_ != 0; }

    void commit();

  private:
    void collectInMemory();
    void replace();

    OutputTarget target_;
    TemporaryFile temporary_; // empty: the bytes wait in memory
    int descriptor_ = -1;     // holds the bytes until the commit
    int firstErrno_ = 0;
};

void writeText(const std::filesystem::path& path, std::string_view text);

} // namespace metamarch
