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
// as it is. A file that is replaced hands down its mode and, where that is permitted, its owner.
//
// What cannot be renamed over is written at commit(), once everything is there: devices, pipes, the standard
// streams (see OutputTarget), a file in a folder that takes no new files, and a file that is a mount point.
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
    TemporaryFile temporary_; // empty: what is written waits in memory
    int descriptor_ = -1;     // of what is written, until the commit
    int firstErrno_ = 0;
};

void writeText(const std::filesystem::path& path, std::string_view text);

} // namespace metamarch
