// SPDX-License-Identifier: MIT
// An output file that appears under its name only when it is complete.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace metamarch {

// Writes to a temporary file in the same folder; commit() renames it. Without a commit the temporary file is
// removed and an existing file stays as it is. Symbolic links are followed. Devices, pipes and folders are
// refused, because a rename would replace them. To check that a path is writable, construct an OutputFile and
// destroy it. The constructor and commit() throw Error(outputNotWritable).
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
    std::filesystem::path shownPath_; // as the user typed it, for messages
    std::filesystem::path finalPath_;
    std::filesystem::path temporaryPath_;
    int descriptor_ = -1;
    int firstErrno_ = 0;
};

void writeText(const std::filesystem::path& path, std::string_view text);

} // namespace metamarch
