// A file that appears under its name only when it is complete: never half a file.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace metamarch {

// Bytes go to a temporary file in the same folder; commit() renames it. Without a commit the temporary is
// removed and whatever was there before stays. A symbolic link is followed; devices, pipes and folders are
// refused, because a rename would replace them. Creating one and letting it go checks that the place is
// writable. Errors: Error(outputNotWritable), from the constructor and from commit().
class OutputFile {
  public:
    explicit OutputFile(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    // Returns false on failure and from then on; the reason is kept for commit(). Never throws: image
    // libraries call it from the inside.
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
